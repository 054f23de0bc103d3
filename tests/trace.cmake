# Tests of the tracer: the referee with its scenes, and the programs that hold the engine against it.
set(referee ${CMAKE_SOURCE_DIR}/tests/referee)
add_library(strahl_referee STATIC ${referee}/referee.cpp ${referee}/random_scene.cpp ${referee}/examples.cpp)
target_link_libraries(strahl_referee PUBLIC strahl_scene)

strahl_tests(test_trace unit/trace "strahl_text;strahl_image;strahl_trace;strahl_referee")
strahl_tests(test_trace unit/scene "")
strahl_tests(test_trace unit "" structure)
# It makes a kernel of its own.
set_source_files_properties(${CMAKE_SOURCE_DIR}/tests/unit/trace/area_light.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
# It starts threads in place of the C library.
strahl_tests(test_thread_pool unit "strahl_text;strahl_trace" thread_pool)
# Leaves `thin` out with sanitizers, where it would take long: `sampling` runs the same code.
set_tests_properties(thin PROPERTIES LABELS slow)
# The label `figures` is for tests of what numbers come out: sanitizers see their code in `hashes`, `kernel` and
# `attack_renderer`, which trace all kinds of worlds, and tests/run leaves them out there.
set_tests_properties(accuracy area_light bound footprints history light_culling pattern_means patterns reliefs
                     structure PROPERTIES LABELS figures)
