# Scenes as values and as text.
strahl_tests(test_text unit/scene "" scene overlap solid)
set_tests_properties(overlap PROPERTIES LABELS figures)
strahl_tests(test_text unit/text "strahl_text;strahl_image")
strahl_tests(test_text unit/files "")
# With sanitizers the language's other tests and attack_parser read and write as much.
set_tests_properties(roundtrip PROPERTIES LABELS figures)
strahl_tests(test_import unit/import strahl_import)

# The tables of the manual: the test fails if they are stale, the target `manual` writes them.
add_executable(write_manual EXCLUDE_FROM_ALL manual/main.cpp)
target_link_libraries(write_manual PRIVATE strahl_text)
add_custom_target(manual COMMAND write_manual ${CMAKE_SOURCE_DIR}/src/text/README.md DEPENDS write_manual)
