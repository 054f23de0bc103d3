# Proofs: bounds that travel with rays, held against exact arithmetic. See tests/proof/README.md.
add_executable(test_proof ${CMAKE_SOURCE_DIR}/tests/proof/soundness.cpp ${CMAKE_SOURCE_DIR}/tests/proof/formulas_of_bodies.cpp ${CMAKE_SOURCE_DIR}/tests/proof/formulas_of_rays.cpp)
target_link_libraries(test_proof PRIVATE strahl_doctest strahl_image strahl_trace strahl_referee)
add_test(NAME proof COMMAND test_proof)
