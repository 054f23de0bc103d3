# Attacks on the finished program: failing allocations, threads and file calls, kills, power cuts.
set(attack ${CMAKE_SOURCE_DIR}/tests/attack/program)
# No sanitizers in what is loaded before them.
add_library(strahl_fail MODULE ${attack}/fail.cpp ${attack}/calls.cpp)
add_executable(attack_io ${attack}/io.cpp ${attack}/attacked.cpp ${attack}/cases.cpp ${attack}/faults.cpp
               ${attack}/verdict.cpp ${attack}/kills.cpp ${attack}/disk.cpp ${attack}/power.cpp)
target_compile_options(strahl_fail PRIVATE -Wall -Wextra)
set_target_properties(attack_io PROPERTIES UNITY_BUILD ON)
if(NOT STRAHL_SANITIZE)
  target_link_libraries(attack_io PRIVATE strahl_flags)
endif()
if(STRAHL_SANITIZE)
  target_compile_definitions(strahl_fail PRIVATE STRAHL_SANITIZED)
endif()
target_link_libraries(strahl_fail PRIVATE ${CMAKE_DL_LIBS})
foreach(part faults kills power)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/attack_${part})
  file(MAKE_DIRECTORY ${folder})
  add_test(NAME attack_${part} WORKING_DIRECTORY ${folder}
           COMMAND attack_io ${part} --seconds 5 $<TARGET_FILE:strahl> $<TARGET_FILE:strahl_fail>)
endforeach()
if(TARGET attack)
  add_dependencies(attack strahl strahl_fail attack_io)
endif()
# With sanitizers a film takes too long for the few seconds that it is killed in.
set_tests_properties(attack_kills attack_power PROPERTIES LABELS slow)
