# The scene as a value, and its text.
strahl_test(scene strahl_scene)
strahl_test(overlap strahl_scene)
strahl_test(language strahl_text)
strahl_test(roundtrip strahl_text)

# The parser under strange input: with a mutator of our own, seconds in every test run, hours when asked
# (fuzz_parser --seconds 3600); and under libFuzzer where the compiler is clang.
add_executable(fuzz_parser fuzz/parser.cpp fuzz/mutate.cpp)
target_link_libraries(fuzz_parser PRIVATE strahl_text)
add_test(NAME fuzz_parser COMMAND fuzz_parser --seconds 5 ${CMAKE_SOURCE_DIR}/scenes)
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  add_executable(libfuzzer_parser EXCLUDE_FROM_ALL fuzz/parser.cpp)
  target_link_libraries(libfuzzer_parser PRIVATE strahl_text)
  target_link_options(libfuzzer_parser PRIVATE -fsanitize=fuzzer)
endif()
