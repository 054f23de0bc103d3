# Scenes as values and as text.
strahl_test(scene strahl_scene)
strahl_test(overlap strahl_scene)
strahl_test(language strahl_text)
strahl_test(roundtrip strahl_text)

# The tables of the manual: the test fails if they are stale, the target `manual` writes them.
strahl_test(manual strahl_text)
add_executable(write_manual EXCLUDE_FROM_ALL manual/main.cpp)
target_link_libraries(write_manual PRIVATE strahl_text)
add_custom_target(manual COMMAND write_manual ${CMAKE_SOURCE_DIR}/src/text/README.md DEPENDS write_manual)

# Fuzzing of the parser: with our own mutator, for seconds in every test run or longer by hand (fuzz_parser --seconds
# 3600); and with libFuzzer if the compiler is clang.
add_executable(fuzz_parser fuzz/parser.cpp fuzz/mutate.cpp)
target_link_libraries(fuzz_parser PRIVATE strahl_text)
add_test(NAME fuzz_parser COMMAND fuzz_parser --seconds 5 ${CMAKE_SOURCE_DIR}/scenes)
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  add_executable(libfuzzer_parser EXCLUDE_FROM_ALL fuzz/parser.cpp)
  target_link_libraries(libfuzzer_parser PRIVATE strahl_text)
  target_link_options(libfuzzer_parser PRIVATE -fsanitize=fuzzer)
endif()
