# Conversion to POV-Ray and stored pictures; and POV-Ray itself, which must be installed.
strahl_tests(test_povref unit/povref "strahl_povref;strahl_pov;strahl_referee")
set_tests_properties(povray PROPERTIES LABELS slow TIMEOUT 600)
set_tests_properties(povref_agreement pov_again PROPERTIES LABELS figures)
target_sources(test_povref PRIVATE ${CMAKE_SOURCE_DIR}/src/main/commands/command_pov.cpp
                                   ${CMAKE_SOURCE_DIR}/src/main/commands/scene_file.cpp)
