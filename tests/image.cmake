# Files, pictures and their comparison, and the parts of the commands that need nothing else.
strahl_test(file strahl_text)
strahl_test(picture strahl_image)
strahl_test(bands strahl_image)
strahl_test(hostile_pictures strahl_image)
strahl_test(compare strahl_image)
strahl_test(progress strahl_flags)
target_sources(test_compare PRIVATE ${CMAKE_SOURCE_DIR}/src/main/command_compare.cpp)
target_sources(test_progress PRIVATE ${CMAKE_SOURCE_DIR}/src/main/progress.cpp)
