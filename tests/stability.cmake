# The stability suite: where methods of ray tracing fail, and that Strahl does not. See tests/stability/README.md.
set(stability ${CMAKE_SOURCE_DIR}/tests/stability)
add_library(strahl_stage STATIC ${stability}/stage.cpp)
target_link_libraries(strahl_stage PUBLIC strahl_trace strahl_referee)

function(strahl_stability_test name)
  add_executable(stability_${name} ${stability}/${name}.cpp)
  target_link_libraries(stability_${name} PRIVATE strahl_doctest strahl_stage ${ARGN})
  add_test(NAME stability_${name} COMMAND stability_${name})
endfunction()

strahl_stability_test(meshes)
strahl_stability_test(composites)
strahl_stability_test(extremes strahl_text)
# Sanitizers find nothing in what numbers come out: of these only the figures count.
if(NOT STRAHL_SANITIZE)
  foreach(name spheres planes starts cylinders cones random_cones boxed tori coincident chains media properties boxes)
    strahl_stability_test(${name})
  endforeach()
  strahl_stability_test(cameras_and_transformations strahl_text)
endif()

# The pictures of tests/stability/README.md: `ninja stability_pictures_drawn`.
if(TARGET strahl_image)
  add_executable(stability_pictures ${stability}/pictures.cpp)
  target_link_libraries(stability_pictures PRIVATE strahl_stage strahl_image)
  # Where the picture module is looked for.
  set_target_properties(stability_pictures PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  add_custom_target(stability_pictures_drawn COMMAND stability_pictures ${stability}/pictures DEPENDS stability_pictures)
endif()
