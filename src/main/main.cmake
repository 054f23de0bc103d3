# The program: the options of all commands, and a file for the work of each.
file(GLOB sources CONFIGURE_DEPENDS src/main/*.cpp src/main/*/*.cpp)
list(FILTER sources EXCLUDE REGEX "/(options|lsp)/")
if(NOT TARGET strahl_show)
  list(FILTER sources EXCLUDE REGEX "/command_view\\.cpp$")
  list(APPEND sources ${CMAKE_SOURCE_DIR}/src/main/commands/without_window/command_view.cpp)
endif()
strahl_module(lsp src/main/lsp strahl_pov strahl_image)  # apart from the rest, which need not read the JSON library
add_executable(strahl ${sources})
file(READ ${CMAKE_SOURCE_DIR}/LICENSE licence)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/main/licence.h @ONLY
     CONTENT "inline constexpr const char* licence = R\"licence(@licence@)licence\";\n")
target_include_directories(strahl PRIVATE ${CMAKE_BINARY_DIR}/generated)
target_link_libraries(strahl PRIVATE strahl_lsp strahl_import strahl_pov strahl_image strahl_trace strahl_povref)
if(TARGET strahl_show)
  target_link_libraries(strahl PRIVATE strahl_show)
endif()
# Reading options takes no time, but CLI11 takes long to compile: once, without optimising.
file(GLOB options CONFIGURE_DEPENDS src/main/options/*.cpp)
add_library(strahl_options OBJECT ${options})
target_compile_definitions(strahl_options PRIVATE STRAHL_VERSION="${PROJECT_VERSION}")
target_compile_options(strahl_options PRIVATE -O0)
target_link_libraries(strahl_options PRIVATE strahl_flags)
set_target_properties(strahl_options PROPERTIES UNITY_BUILD ON)
target_link_libraries(strahl PRIVATE strahl_options)
# Installed with libraries of its own, it finds these beside its module for reading pictures; they find each other there,
# too, by the older of the linker's two kinds of such paths.
set_target_properties(strahl PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}
                      BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN/../lib/strahl")
if(NOT WIN32)
  target_link_options(strahl PRIVATE -Wl,--disable-new-dtags)
endif()

include(src/main/package.cmake)
