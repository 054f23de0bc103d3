# The campaign of tests/attack/README.md: what `tests/attack/run` builds, and short versions of its parts as tests.
set(attack ${CMAKE_SOURCE_DIR}/tests/attack)
add_custom_target(attack)

# The parser: with a mutator of our own in every test run, and with libFuzzer in the preset `fuzz`.
add_executable(attack_parser ${attack}/parser.cpp ${attack}/mutate.cpp)
target_link_libraries(attack_parser PRIVATE strahl_text)
add_dependencies(attack attack_parser)
add_test(NAME attack_parser COMMAND attack_parser --seconds 5 ${attack}/language.dict ${attack}/seeds ${CMAKE_SOURCE_DIR}/scenes)
set_tests_properties(attack_parser PROPERTIES LABELS memory)
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  add_executable(attack_libfuzzer EXCLUDE_FROM_ALL ${attack}/parser.cpp)
  target_link_libraries(attack_libfuzzer PRIVATE strahl_text)
  target_link_options(attack_libfuzzer PRIVATE -fsanitize=fuzzer)
endif()

# Bodies with degenerate values, against the referee.
add_library(strahl_body_check STATIC ${attack}/bodies/body_check.cpp ${attack}/bodies/degenerate_scene.cpp)
target_link_libraries(strahl_body_check PUBLIC strahl_trace strahl_referee)
add_executable(attack_bodies ${attack}/bodies/bodies.cpp)
target_link_libraries(attack_bodies PRIVATE strahl_body_check strahl_text)
add_dependencies(attack attack_bodies)

# The renderer. In the sanitize preset only the scalar level is instrumented.
add_library(strahl_picture_check STATIC ${attack}/renderer/picture_check.cpp
            ${attack}/renderer/shrink.cpp)
target_link_libraries(strahl_picture_check PUBLIC strahl_text strahl_trace)
add_executable(attack_renderer ${attack}/renderer/renderer.cpp ${attack}/renderer/wild_scene.cpp
               ${attack}/renderer/wild_materials.cpp ${attack}/renderer/wild_values.cpp)
target_link_libraries(attack_renderer PRIVATE strahl_picture_check)
strahl_tests(test_attacked unit/trace "strahl_picture_check;strahl_body_check" attacked)
set_tests_properties(attacked PROPERTIES LABELS figures)
add_dependencies(attack attack_renderer)
add_test(NAME attack_renderer COMMAND attack_renderer --seconds 5)

# Random scenes, against POV-Ray, which must be installed.
add_library(strahl_povray_scene STATIC ${attack}/povray/povray_scene.cpp)
target_link_libraries(strahl_povray_scene PUBLIC strahl_referee)
add_executable(attack_povray ${attack}/povray/povray.cpp ${attack}/povray/reasons.cpp)
target_link_libraries(attack_povray PRIVATE strahl_povray_scene strahl_povref strahl_picture_check)
add_dependencies(attack attack_povray)

# The readers of pictures and of meshes.
add_library(strahl_file_attack STATIC ${attack}/file_attack.cpp)
target_link_libraries(strahl_file_attack PUBLIC strahl_flags)
add_executable(attack_pictures ${attack}/pictures.cpp ${attack}/mutated_picture.cpp)
target_link_libraries(attack_pictures PRIVATE strahl_file_attack strahl_image)
add_executable(attack_meshes ${attack}/meshes.cpp ${attack}/mutated_mesh.cpp)
target_link_libraries(attack_meshes PRIVATE strahl_file_attack strahl_mesh)
add_executable(attack_models ${attack}/models.cpp)
target_link_libraries(attack_models PRIVATE strahl_file_attack strahl_import)
set(attacked_files pictures meshes models)
# The small readers, three of which are the window's: without the rest of it, so that the preset `fuzz` has them too.
pkg_check_modules(VORBIS IMPORTED_TARGET vorbisfile)
if(VORBIS_FOUND)
  set(readers ${attack}/readers.cpp ${CMAKE_SOURCE_DIR}/src/show/work/rocket.cpp
              ${CMAKE_SOURCE_DIR}/src/show/window/window_state.cpp ${CMAKE_SOURCE_DIR}/src/show/window/with/samples.cpp)
  add_executable(attack_small_files ${attack}/small_files.cpp ${readers})
  target_compile_definitions(attack_small_files PRIVATE STRAHL_SOURCE="${CMAKE_SOURCE_DIR}")
  target_link_libraries(attack_small_files PRIVATE strahl_file_attack strahl_image strahl_text PkgConfig::VORBIS)
  list(APPEND attacked_files small_files)
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    add_executable(attack_libfuzzer_readers EXCLUDE_FROM_ALL ${attack}/readers_fuzzer.cpp ${readers})
    target_link_libraries(attack_libfuzzer_readers PRIVATE strahl_image strahl_text PkgConfig::VORBIS)
    target_link_options(attack_libfuzzer_readers PRIVATE -fsanitize=fuzzer)
  endif()
endif()
foreach(files ${attacked_files})
  add_dependencies(attack attack_${files})
  add_test(NAME attack_${files} COMMAND attack_${files} --seconds $<IF:$<OR:$<STREQUAL:${files},models>,$<STREQUAL:${files},small_files>>,2,5>)
  set_tests_properties(attack_${files} PROPERTIES LABELS memory)
endforeach()

# The readers of other programs' scenes, and the language of POV-Ray's. They run in a folder of their own.
function(attack_scenes name library seeds)
  file(GLOB scenes ${attack}/${seeds})
  add_executable(attack_${name} ${attack}/${name}.cpp ${attack}/mutate.cpp)
  target_link_libraries(attack_${name} PRIVATE ${library})
  add_dependencies(attack attack_${name})
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/attack_${name}.files)
  add_test(NAME attack_${name} WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/attack_${name}.files
           COMMAND attack_${name} --seconds 5 ${attack}/import.dict ${scenes})
  set_tests_properties(attack_${name} PROPERTIES LABELS memory)
endfunction()
attack_scenes(importer strahl_import import/*)
attack_scenes(pov_language strahl_pov pov/*)
