# Files, pictures and their comparison, and the parts of the commands that need nothing else.
# The next two replace functions of the C library and the sanitizers' options, each for itself.
strahl_tests(test_file unit strahl_text file)
strahl_tests(test_picture unit/image strahl_image picture strange_pictures)
strahl_tests(test_image unit/image "strahl_image;strahl_text" bands hostile_pictures)
strahl_tests(test_image unit/main "" compare progress)
target_sources(test_image PRIVATE ${CMAKE_SOURCE_DIR}/src/main/commands/command_compare.cpp
                                  ${CMAKE_SOURCE_DIR}/src/main/process/progress.cpp)
# So does this.
strahl_tests(test_film unit/main strahl_image film_start values)
target_sources(test_film PRIVATE ${CMAKE_SOURCE_DIR}/src/main/render/values.cpp)
