# The program and the launcher as users see them: one bash script per topic.
foreach(topic usage pictures frames resume interrupt files stats stability check import broken_scenes install launcher readme crosscheck farm)
  add_test(NAME command_${topic}
           COMMAND bash ${CMAKE_SOURCE_DIR}/tests/command/${topic}.sh $<TARGET_FILE:strahl> ${CMAKE_SOURCE_DIR}
                   ${CMAKE_BINARY_DIR})
endforeach()
set_tests_properties(command_pictures command_farm PROPERTIES LABELS slow)
