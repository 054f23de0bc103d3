# Tests of the tracer: the referee with its scenes, and the programs that hold the engine against it.
set(referee ${CMAKE_SOURCE_DIR}/tests/referee)
add_library(strahl_referee STATIC ${referee}/referee.cpp ${referee}/random_scene.cpp ${referee}/examples.cpp)
target_link_libraries(strahl_referee PUBLIC strahl_scene quadmath)

strahl_test(referee strahl_referee)
strahl_test(structure)
strahl_test(kernel strahl_trace strahl_referee)
strahl_test(light_culling strahl_text strahl_trace strahl_referee)
strahl_test(hierarchy strahl_trace)
strahl_test(thread_pool strahl_text strahl_trace)
strahl_test(bound strahl_trace strahl_referee)
strahl_test(accuracy strahl_text strahl_trace)
strahl_test(tracing strahl_text strahl_trace strahl_referee)
