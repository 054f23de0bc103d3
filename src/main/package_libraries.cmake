# Read by cpack: finds the packages of the libraries that the program needs, and of those that only its module for
# reading .exr and .gif files needs, without which it works.
find_program(SHLIBDEPS dpkg-shlibdeps)
if(NOT SHLIBDEPS)
  message(FATAL_ERROR "a Debian package needs dpkg-shlibdeps: install the package dpkg-dev")
endif()
set(sysroot)
if(CPACK_STRAHL_SYSROOT)  # whose folder DEBIAN names the packages of its libraries
  set(sysroot -S${CPACK_STRAHL_SYSROOT})
  set(ENV{DEB_HOST_ARCH} ${CPACK_DEBIAN_PACKAGE_ARCHITECTURE})
endif()
# Sets `result` to a list such as "libc6 (>= 2.34);libglfw3 (>= 3.0)".
function(libraries_of file result)
  file(WRITE ${CPACK_PACKAGE_DIRECTORY}/shlibdeps/debian/control
       "Source: strahl\n\nPackage: strahl\nArchitecture: any\n")
  execute_process(COMMAND ${SHLIBDEPS} -O --ignore-missing-info ${sysroot} ${file} OUTPUT_VARIABLE said ERROR_QUIET
                  WORKING_DIRECTORY ${CPACK_PACKAGE_DIRECTORY}/shlibdeps RESULT_VARIABLE fails)
  if(fails)
    message(FATAL_ERROR "dpkg-shlibdeps does not know the libraries of ${file}")
  endif()
  string(REGEX REPLACE ".*shlibs:Depends=([^\n]*).*" "\\1" said "${said}")
  string(REPLACE ", " ";" said "${said}")
  set(${result} "${said}" PARENT_SCOPE)
endfunction()
libraries_of(${CPACK_STRAHL_PROGRAM} depends)
libraries_of(${CPACK_STRAHL_MODULE} recommends)
list(TRANSFORM depends REPLACE " .*" "" OUTPUT_VARIABLE names)
foreach(package ${recommends})
  string(REGEX REPLACE " .*" "" name ${package})
  list(FIND names ${name} known)
  if(NOT known EQUAL -1)  # in whatever version
    list(REMOVE_ITEM recommends ${package})
  endif()
endforeach()
list(TRANSFORM depends REPLACE "^(libturbojpeg)0( .*)?$" "\\0 | \\1")  # as Ubuntu calls it
list(JOIN depends ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
list(APPEND recommends povray-includes)  # what scenes of POV-Ray include
list(JOIN recommends ", " CPACK_DEBIAN_PACKAGE_RECOMMENDS)
file(REMOVE_RECURSE ${CPACK_PACKAGE_DIRECTORY}/shlibdeps)
