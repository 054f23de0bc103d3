# The window. OpenGL is loaded through GLFW at run time, so that the other commands start without it.
pkg_check_modules(GLFW REQUIRED IMPORTED_TARGET glfw3)
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
strahl_module(show src/show strahl_text strahl_image strahl_trace PkgConfig::IMGUI PkgConfig::GLFW)
