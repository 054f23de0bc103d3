# The stability suite: where methods of ray tracing fail, and that the engine holds. See tests/stability/README.md.
set(stability ${CMAKE_SOURCE_DIR}/tests/stability)
add_library(strahl_stage STATIC ${stability}/stage.cpp)
target_link_libraries(strahl_stage PUBLIC strahl_trace strahl_referee)

function(strahl_stability_test name)
  add_executable(stability_${name} ${stability}/${name}.cpp)
  target_link_libraries(stability_${name} PRIVATE strahl_doctest strahl_stage ${ARGN})
  add_test(NAME stability_${name} COMMAND stability_${name})
endfunction()

strahl_stability_test(spheres)
strahl_stability_test(planes)
strahl_stability_test(starts)
strahl_stability_test(cylinders)
strahl_stability_test(coincident)
strahl_stability_test(chains)
strahl_stability_test(media)
strahl_stability_test(cameras_and_transformations strahl_text)
strahl_stability_test(extremes strahl_text)
strahl_stability_test(properties)
strahl_stability_test(boxes)
target_compile_definitions(stability_boxes PRIVATE STRAHL_LEVEL=stability)  # lanes of its own, apart from the kernels
