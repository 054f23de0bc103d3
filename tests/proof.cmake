# Proofs: bounds that travel with rays, held against exact arithmetic. See tests/proof/README.md.
file(GLOB strahl_proof_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/proof/*.cpp)
# One object for each file, which tests/proof/mutate replaces.
set_source_files_properties(${strahl_proof_sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
add_executable(test_proof ${strahl_proof_sources})
target_link_libraries(test_proof PRIVATE strahl_doctest strahl_image strahl_trace strahl_referee)
# Trials of formulas run code of headers alone, which is not instrumented.
foreach(source ${strahl_proof_sources})
  get_filename_component(name ${source} NAME_WE)
  if(NOT (STRAHL_SANITIZE AND name MATCHES "^(formulas_.*|photon)$"))
    add_test(NAME proof_${name} COMMAND test_proof --source-file=*/proof/${name}.cpp)
    set_tests_properties(proof_${name} PROPERTIES FAIL_REGULAR_EXPRESSION "test cases: +0 ")
  endif()
endforeach()
