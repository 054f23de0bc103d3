# The program: main.cpp with the options of all commands, and a file for the work of each.
file(GLOB sources CONFIGURE_DEPENDS src/main/*.cpp src/main/*/*.cpp)
if(NOT TARGET strahl_show)
  list(FILTER sources EXCLUDE REGEX "/command_view\\.cpp$")
  list(APPEND sources src/main/commands/without_window/command_view.cpp)
endif()
add_executable(strahl ${sources})
file(READ ${CMAKE_SOURCE_DIR}/LICENSE licence)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/main/licence.h @ONLY
     CONTENT "inline constexpr const char* licence = R\"licence(@licence@)licence\";\n")
target_include_directories(strahl PRIVATE ${CMAKE_BINARY_DIR}/generated)
target_link_libraries(strahl PRIVATE strahl_text strahl_import strahl_image strahl_trace strahl_povref)
if(TARGET strahl_show)
  target_link_libraries(strahl PRIVATE strahl_show)
endif()
# Reading options takes no time, but CLI11 takes long to compile.
set_source_files_properties(src/main/main.cpp PROPERTIES COMPILE_DEFINITIONS STRAHL_VERSION="${PROJECT_VERSION}"
                                                         COMPILE_OPTIONS -O0 SKIP_PRECOMPILE_HEADERS ON)
set_target_properties(strahl PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

include(src/main/package.cmake)
