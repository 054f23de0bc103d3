# Readers of mesh files.
strahl_test(mesh_files strahl_mesh)
strahl_test(hostile_meshes strahl_mesh)
