# Proofs: bounds that travel with rays, held against exact arithmetic. See tests/proof/README.md.
file(GLOB strahl_proof_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/proof/*.cpp)
add_executable(test_proof ${strahl_proof_sources})
target_link_libraries(test_proof PRIVATE strahl_doctest strahl_image strahl_trace strahl_referee)
foreach(source ${strahl_proof_sources})
  get_filename_component(name ${source} NAME_WE)
  add_test(NAME proof_${name} COMMAND test_proof --source-file=*/proof/${name}.cpp)
  set_tests_properties(proof_${name} PROPERTIES FAIL_REGULAR_EXPRESSION "test cases: +0 ")
  if(name MATCHES "^(formulas_.*|photon)$")  # code of headers alone, which is not instrumented
    set_tests_properties(proof_${name} PROPERTIES LABELS figures)
  endif()
endforeach()
