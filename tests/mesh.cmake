# Readers of mesh files.
strahl_tests(test_mesh unit/mesh strahl_mesh mesh_files hostile_meshes strange_meshes)
