# The program: one thin file per command, and main.cpp, which knows their options.
file(GLOB sources CONFIGURE_DEPENDS src/main/*.cpp)
add_executable(strahl ${sources})
target_link_libraries(strahl PRIVATE strahl_text strahl_image strahl_trace)
set_source_files_properties(src/main/main.cpp PROPERTIES COMPILE_DEFINITIONS STRAHL_VERSION="${PROJECT_VERSION}")
set_target_properties(strahl PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

install(TARGETS strahl RUNTIME DESTINATION bin)
install(DIRECTORY scenes assets DESTINATION share/strahl)
install(FILES LICENSE README.md DESTINATION share/doc/strahl)
