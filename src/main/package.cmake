# What is installed, and `cpack`, which makes a Debian package of it.

set(desktop ${CMAKE_SOURCE_DIR}/assets/desktop)
# The program prints what other programs read about it. Zipped as Debian wants it: without name and time.
set(reference ${CMAKE_BINARY_DIR}/reference)
set(references man:strahl.1 bash:strahl zsh:_strahl fish:strahl.fish vim:strahl.vim textmate:strahl.tmLanguage.json)
set(reference_files)
file(MAKE_DIRECTORY ${reference})
set(commands)
foreach(entry ${references})
  string(REGEX MATCH "(.*):(.*)" entry ${entry})
  list(APPEND reference_files ${reference}/${CMAKE_MATCH_2})
  list(APPEND commands COMMAND strahl --reference ${CMAKE_MATCH_1} > ${reference}/${CMAKE_MATCH_2})
endforeach()
add_custom_command(OUTPUT ${reference_files} ${reference}/strahl.1.gz ${reference}/changelog.gz
                   ${commands} COMMAND gzip -9nkf strahl.1
                   COMMAND gzip -9nc ${desktop}/changelog > changelog.gz
                   WORKING_DIRECTORY ${reference} DEPENDS strahl ${desktop}/changelog VERBATIM)
add_custom_target(reference ALL DEPENDS ${reference_files})

install(TARGETS strahl RUNTIME DESTINATION bin)
install(DIRECTORY scenes DESTINATION share/strahl)
install(DIRECTORY assets DESTINATION share/strahl PATTERN desktop EXCLUDE)
install(FILES LICENSE README.md DESTINATION share/doc/strahl)
install(FILES ${reference}/strahl.1.gz DESTINATION share/man/man1)
install(FILES ${reference}/strahl DESTINATION share/bash-completion/completions)
install(FILES ${reference}/_strahl DESTINATION share/zsh/vendor-completions)
install(FILES ${reference}/strahl.fish DESTINATION share/fish/vendor_completions.d)
install(FILES ${reference}/strahl.vim DESTINATION share/vim/vimfiles/syntax)
install(FILES ${desktop}/filetype.vim DESTINATION share/vim/vimfiles/ftdetect RENAME strahl.vim)
install(FILES ${reference}/strahl.tmLanguage.json DESTINATION share/strahl)
install(FILES ${desktop}/strahl.desktop DESTINATION share/applications)
install(FILES ${desktop}/strahl.xml DESTINATION share/mime/packages)
install(FILES ${desktop}/strahl.svg DESTINATION share/icons/hicolor/scalable/apps)
install(FILES ${desktop}/strahl.metainfo.xml DESTINATION share/metainfo)
install(FILES ${desktop}/lintian-overrides DESTINATION share/lintian/overrides RENAME strahl)  # CPack calls it for any .so
install(FILES ${desktop}/copyright ${reference}/changelog.gz DESTINATION share/doc/strahl)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(STRAHL_MAINTAINER "The Strahl authors <noreply@strahl.invalid>" CACHE STRING "Whom the package names as its maintainer")
set(CPACK_PACKAGE_CONTACT ${STRAHL_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "fast and exact recursive ray tracer")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Strahl renders scenes of spheres, planes, meshes and their combinations with\nmirrors, glass and shadows, flies through them in a window while they are\ntraced, and compares its pictures with those of POV-Ray.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "povray, ffmpeg")
set(CPACK_STRIP_FILES ON)
include(CPack)
