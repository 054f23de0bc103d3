# Pictures: .png and .jpg by libraries whose versions are compatible over all releases of Debian and Ubuntu, and a module
# with OpenImageIO, whose are not; it is loaded only when an .exr, a .gif or a .bmp with run lengths is read.
pkg_check_modules(ZLIB REQUIRED IMPORTED_TARGET zlib)
pkg_check_modules(PNG REQUIRED IMPORTED_TARGET libpng)
pkg_check_modules(TURBOJPEG REQUIRED IMPORTED_TARGET libturbojpeg)
strahl_module(image src/image strahl_text)
get_target_property(sources strahl_image SOURCES)
list(FILTER sources EXCLUDE REGEX "/oiio/")
set_property(TARGET strahl_image PROPERTY SOURCES ${sources})
target_link_libraries(strahl_image PRIVATE PkgConfig::PNG PkgConfig::TURBOJPEG PkgConfig::ZLIB)

if(WIN32)
  return()  # OpenImageIO is not built for Windows
endif()
# Not find_package(OpenImageIO): that of Debian 12 is broken (it requires a missing iconvert).
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET OpenImageIO>=2.4)
add_library(strahl_picture_module MODULE src/image/oiio/oiio_module.cpp)
target_link_libraries(strahl_picture_module PRIVATE strahl_flags PkgConfig::OIIO)
# Its place relative to the programs is the same in the build folder as when installed.
set_target_properties(strahl_picture_module PROPERTIES OUTPUT_NAME strahl_image CXX_VISIBILITY_PRESET hidden NO_SONAME ON
                      LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/strahl)
# So that a program that links strahl_image can be run as soon as it is built.
add_dependencies(strahl_image strahl_picture_module)
install(TARGETS strahl_picture_module LIBRARY DESTINATION lib/strahl)
