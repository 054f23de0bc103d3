# The program and the launcher as users see them: one bash script per topic.
file(GLOB topics CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/tests/command ${CMAKE_SOURCE_DIR}/tests/command/*.sh)
list(TRANSFORM topics REPLACE "\\.sh$" "")
list(REMOVE_ITEM topics expect slurm)  # parts of others
foreach(topic ${topics})
  add_test(NAME command_${topic}
           COMMAND bash ${CMAKE_SOURCE_DIR}/tests/command/${topic}.sh $<TARGET_FILE:strahl> ${CMAKE_SOURCE_DIR}
                   ${CMAKE_BINARY_DIR})
endforeach()
# With sanitizers these take minutes, and show no more of the program than the others do.
set_tests_properties(command_pictures command_farm command_film command_resume command_install command_gallery
                     command_readme command_crosscheck command_crosscheck_strangers PROPERTIES LABELS slow)
# These show the same in every build.
set_tests_properties(command_usage command_files command_check command_import command_models command_broken_scenes
                     PROPERTIES LABELS memory)
add_test(NAME layout COMMAND bash ${CMAKE_SOURCE_DIR}/tests/layout.sh $<TARGET_FILE:strahl> ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR})
# These start other programs only.
set_tests_properties(command_launcher command_ci layout PROPERTIES LABELS figures)

# The language server, without the program.
strahl_tests(test_lsp unit/main strahl_lsp lsp)
