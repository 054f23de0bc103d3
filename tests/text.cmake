# Scenes as values and as text.
strahl_test(scene strahl_scene)
strahl_test(overlap strahl_scene)
strahl_test(language strahl_text)
strahl_test(language_errors strahl_text)
strahl_test(language_values strahl_text)
strahl_test(language_composites strahl_text)
strahl_test(language_patterns strahl_text)
strahl_test(hostile_text strahl_text)
strahl_test(roundtrip strahl_text)
strahl_test(dictionary strahl_text)
strahl_test(import_nff strahl_import)
strahl_test(import_tachyon strahl_import)

# The tables of the manual: the test fails if they are stale, the target `manual` writes them.
strahl_test(manual strahl_text)
add_executable(write_manual EXCLUDE_FROM_ALL manual/main.cpp)
target_link_libraries(write_manual PRIVATE strahl_text)
add_custom_target(manual COMMAND write_manual ${CMAKE_SOURCE_DIR}/src/text/README.md DEPENDS write_manual)
