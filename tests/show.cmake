# The window: its parts without a display, and the program itself on a virtual one.
if(TARGET strahl_show)
  strahl_test(progressive strahl_show)
  strahl_test(flying strahl_show)
  strahl_test(show_threads strahl_show)
  add_test(NAME window COMMAND bash ${CMAKE_SOURCE_DIR}/tests/window/run.sh $<TARGET_FILE:strahl>)
  add_test(NAME window_random_input COMMAND bash ${CMAKE_SOURCE_DIR}/tests/window/random_input.sh $<TARGET_FILE:strahl> 10)
  set_tests_properties(window window_random_input PROPERTIES LABELS window SKIP_RETURN_CODE 77 TIMEOUT 300 RUN_SERIAL TRUE)
endif()
