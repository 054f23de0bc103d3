# The stability suite: where methods of ray tracing fail, and that Strahl does not. See tests/stability/README.md.
set(stability ${CMAKE_SOURCE_DIR}/tests/stability)
add_library(strahl_stage STATIC ${stability}/stage.cpp)
target_link_libraries(strahl_stage PUBLIC strahl_trace strahl_referee)

# Sanitizers find nothing in what numbers come out: of most only the figures count.
set(figures)
if(NOT STRAHL_SANITIZE)
  set(figures composites extremes spheres planes starts cylinders cones random_cones boxed tori coincident chains media
      properties boxes cameras_and_transformations)
endif()
strahl_tests(test_stability stability "strahl_stage;strahl_text" meshes ${figures})
foreach(name ${figures})
  set_tests_properties(stability_${name} PROPERTIES LABELS figures)
endforeach()

# The pictures of tests/stability/README.md: `ninja stability_pictures_drawn`.
if(TARGET strahl_image)
  add_executable(stability_pictures ${stability}/pictures.cpp)
  target_link_libraries(stability_pictures PRIVATE strahl_stage strahl_image)
  # Where the picture module is looked for.
  set_target_properties(stability_pictures PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  add_custom_target(stability_pictures_drawn COMMAND stability_pictures ${stability}/pictures DEPENDS stability_pictures)
endif()
