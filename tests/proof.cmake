# Proofs: bounds that travel with rays, held against exact arithmetic. See tests/proof/README.md.
file(GLOB strahl_proof_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/proof/*.cpp)
# One object for each file, which tests/proof/mutate replaces.
set_source_files_properties(${strahl_proof_sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
add_executable(test_proof ${strahl_proof_sources})
target_link_libraries(test_proof PRIVATE strahl_doctest strahl_image strahl_trace strahl_referee)
add_test(NAME proof COMMAND test_proof)
