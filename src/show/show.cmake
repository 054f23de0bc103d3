# The window. OpenGL is loaded through GLFW at run time, so that the other commands start without it.
pkg_check_modules(GLFW REQUIRED IMPORTED_TARGET glfw3)
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
strahl_module(show src/show strahl_pov strahl_povref strahl_image strahl_trace PkgConfig::IMGUI PkgConfig::GLFW)

# Sound, where its libraries are.
option(STRAHL_SOUND "Build sound (needs OpenAL and libvorbisfile)" ON)
if(STRAHL_SOUND)
  pkg_check_modules(SOUND IMPORTED_TARGET openal vorbisfile)
endif()
if(SOUND_FOUND)
  target_sources(strahl_show PRIVATE ${CMAKE_SOURCE_DIR}/src/show/window/with/samples.cpp
                                     ${CMAKE_SOURCE_DIR}/src/show/window/with/sound.cpp)
  target_compile_definitions(PkgConfig::SOUND INTERFACE STRAHL_OPENAL="$<IF:$<BOOL:${WIN32}>,OpenAL32.dll,libopenal.so.1>")
  target_link_libraries(strahl_show PRIVATE PkgConfig::SOUND)
else()
  message(STATUS "building without sound, which needs OpenAL and libvorbisfile")
  target_sources(strahl_show PRIVATE ${CMAKE_SOURCE_DIR}/src/show/window/without/sound.cpp)
endif()
