# Proofs: bounds that travel with rays, held against exact arithmetic. See tests/proof/README.md.
file(GLOB strahl_proof_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/proof/*.cpp)
add_executable(test_proof ${strahl_proof_sources})
target_link_libraries(test_proof PRIVATE strahl_doctest strahl_image strahl_trace strahl_referee)
add_test(NAME proof COMMAND test_proof)
