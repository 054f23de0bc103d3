# The window: its parts without one, and the program itself under a display of its own.
if(TARGET strahl_show)
  strahl_test(progressive strahl_show)
  strahl_test(flying strahl_show)
  strahl_test(show_threads strahl_show)
  add_test(NAME window COMMAND bash ${CMAKE_SOURCE_DIR}/tests/window/run.sh $<TARGET_FILE:strahl>)
  add_test(NAME window_monkey COMMAND bash ${CMAKE_SOURCE_DIR}/tests/window/monkey.sh $<TARGET_FILE:strahl> 10)
  set_tests_properties(window window_monkey PROPERTIES LABELS window SKIP_RETURN_CODE 77 TIMEOUT 300 RUN_SERIAL TRUE)
endif()
