# Readers of mesh files.
strahl_tests(test_mesh unit/mesh strahl_mesh)
