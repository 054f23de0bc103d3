# The tracer: its plain part, and the kernel compiled once per SIMD level: a file for each element type, one for the kinds
# of bodies, one for patterns and lights, and two for proofs. Kernels are optimised in every preset: an inline function
# that is not inlined would merge with another level's when linked.
strahl_module(trace src/trace strahl_scene)
get_target_property(strahl_trace_sources strahl_trace SOURCES)
list(FILTER strahl_trace_sources EXCLUDE REGEX "/(proving_)?kernel\\.cpp$")
set_property(TARGET strahl_trace PROPERTY SOURCES ${strahl_trace_sources})

# The kinds are read from their one list.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/scene/kinds/kinds.h)
file(READ src/scene/kinds/kinds.h strahl_kinds)
string(REGEX REPLACE ".*using Shape = std::variant<([^>]*)>.*" "\\1" strahl_kinds "${strahl_kinds}")
string(REGEX REPLACE "[ \n]*,[ \n]*" ";" strahl_kinds "${strahl_kinds}")
list(REMOVE_ITEM strahl_kinds Mesh Intersection Difference)  # have other kinds' kernels
list(APPEND strahl_kinds SharedMesh)  # a form of worlds alone
list(TRANSFORM strahl_kinds REPLACE "(.+)" "KindCalls<\\1, " OUTPUT_VARIABLE strahl_kind_calls)

# Writes a file that instantiates structs for each element type; each of `structs` is one up to its last argument.
function(strahl_instances file headers structs elements)
  list(TRANSFORM headers REPLACE "(.+)" "#include \"trace/\\1\"\n")
  list(JOIN headers "" content)
  string(APPEND content "namespace strahl::inline STRAHL_LEVEL {\n")
  foreach(begin ${structs})
    foreach(element ${elements})
      string(APPEND content "template struct ${begin}Widest<${element}>>;\n")
    endforeach()
  endforeach()
  file(CONFIGURE OUTPUT ${file} CONTENT "${content}}\n")
endfunction()

set(STRAHL_KERNELS "" CACHE PATH "A build folder to take all kernels but long double from in place of compiling them once more")
function(strahl_kernel level elements)
  set(folder ${CMAKE_BINARY_DIR}/kernels/${level})
  set(sources)
  set(proving ${elements})
  list(REMOVE_ITEM proving float)
  if(STRAHL_LEVELS STREQUAL least OR level STREQUAL v2)
    set(proving)  # v2 is for processors from before 2013: there the scalar level proves
  endif()
  foreach(element ${elements})
    string(REPLACE " " "_" name ${element})
    file(CONFIGURE OUTPUT ${folder}/${name}.cpp CONTENT "#define STRAHL_ELEMENT ${element}\n#include \"trace/kernel/kernel.cpp\"\n")
    list(APPEND sources ${folder}/${name}.cpp)
    if(element IN_LIST proving)
      file(CONFIGURE OUTPUT ${folder}/proving_${name}.cpp
           CONTENT "#define STRAHL_ELEMENT ${element}\n#include \"trace/proof/proving_kernel.cpp\"\n")
      list(APPEND sources ${folder}/proving_${name}.cpp)
    endif()
  endforeach()
  strahl_instances(${folder}/kinds.cpp "forms/kind_kernel.h;forms/composite_kernel.h;forms/listed_kernel.h;forms/shared_mesh_kernel.h" "${strahl_kind_calls}" "${elements}")
  strahl_instances(${folder}/features.cpp "lights/area_light_kernel.h;lights/light_buffer_kernel.h;finish/finish_kernel.h;patterns/pattern_kernel.h"
                   "AreaLightCalls<;LightBufferCalls<;FinishCalls<;PatternCalls<" "${elements}")
  list(APPEND sources ${folder}/kinds.cpp ${folder}/features.cpp)
  if(proving)
    strahl_instances(${folder}/pattern_bounds.cpp "proof/relief_bounds_kernel.h;proof/finish_bounds_kernel.h" "PatternBounds<;FinishBounds<"
                     "${proving}")
    list(APPEND sources ${folder}/pattern_bounds.cpp)
  endif()
  set_property(SOURCE src/trace/simd.cpp APPEND PROPERTY COMPILE_DEFINITIONS STRAHL_KERNEL_${level})
  if(STRAHL_KERNELS AND NOT level STREQUAL long_double)
    # The sources are the same, compiled the same way.
    list(TRANSFORM sources REPLACE "^${CMAKE_BINARY_DIR}/(.*)$" "${STRAHL_KERNELS}/CMakeFiles/kernel_${level}.dir/\\1.o")
    set_source_files_properties(${sources} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
    target_sources(strahl_trace PRIVATE ${sources})
    return()
  endif()
  add_library(kernel_${level} OBJECT ${sources})
  target_link_libraries(kernel_${level} PRIVATE strahl_flags)
  target_compile_definitions(kernel_${level} PRIVATE STRAHL_LEVEL=${level})
  # Points-to analysis takes a third of g++ 12's time here and makes nothing faster; scheduling instructions before
  # register allocation, which is off on x86 by default, makes the code 3 % faster. Functions begin at a cache line, or
  # what else is linked changes the speed by about 5 %.
  target_compile_options(kernel_${level} PRIVATE -O3 -falign-functions=64
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-pta$<SEMICOLON>-fschedule-insns$<SEMICOLON>-fsched-pressure> ${ARGN})
  # All but the kernels themselves: -O2 compiles in three quarters of the time, and its code is as fast. But features.cpp
  # would call functions of std::vector then, which might merge with those of another level.
  if(NOT "-O1" IN_LIST ARGN)
    list(FILTER sources EXCLUDE REGEX "/(float|double|features)\\.cpp$")
    set_source_files_properties(${sources} PROPERTIES COMPILE_OPTIONS -O2)
  elseif(level STREQUAL scalar)
    set_source_files_properties(${folder}/features.cpp PROPERTIES COMPILE_OPTIONS -O3)
  endif()
  if(STRAHL_SANITIZE AND NOT level MATCHES "scalar|long_double")
    # Instrumented packs take g++ a quarter of an hour to compile. Scalars are compiled from the same sources.
    set_target_properties(kernel_${level} PROPERTIES UNSANITIZED ON)
  elseif(STRAHL_SANITIZE)
    target_compile_options(kernel_${level} PRIVATE -O1 $<$<CXX_COMPILER_ID:GNU>:-fno-schedule-insns>)
  endif()
  target_sources(strahl_trace PRIVATE $<TARGET_OBJECTS:kernel_${level}>)
endfunction()

# The levels to build: all that the compiler can; those that this machine can run; its best; or `least`, its best without
# the kernels of proofs. Extended precision is always built; float and double of one lane, which trace where no other
# level runs, are not with `least`: pictures need no more.
set(STRAHL_LEVELS all CACHE STRING "SIMD levels to build: all, runnable for those of this machine, host for its best, \
or least for what pictures need of that")
set(strahl_levels v2 v3 v4 neon)
if(NOT STRAHL_LEVELS STREQUAL all AND EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo strahl_flags_of_cpu REGEX "^flags" LIMIT_COUNT 1)
  set(strahl_levels v2)
  if(strahl_flags_of_cpu MATCHES " avx2 " AND strahl_flags_of_cpu MATCHES " fma ")
    list(APPEND strahl_levels v3)
  endif()
  if(strahl_flags_of_cpu MATCHES " avx512bw " AND strahl_flags_of_cpu MATCHES " avx512vl ")
    list(APPEND strahl_levels v4)
  endif()
  if(STRAHL_LEVELS MATCHES "^(host|least)$")
    # The best ones of all machines that this folder was configured on, which may share it.
    list(GET strahl_levels -1 best)
    list(APPEND STRAHL_HOST_LEVELS ${best})
    list(REMOVE_DUPLICATES STRAHL_HOST_LEVELS)
    set(STRAHL_HOST_LEVELS ${STRAHL_HOST_LEVELS} CACHE INTERNAL "")
    set(strahl_levels ${STRAHL_HOST_LEVELS})
  endif()
endif()
set(STRAHL_BUILT_LEVELS ${strahl_levels} CACHE INTERNAL "")  # which `./strahl` reads
function(strahl_level level)
  if(level IN_LIST strahl_levels)
    strahl_kernel(${level} "float;double" ${ARGN})
  endif()
endfunction()

# The only file that depends on which kernels are built.
set_source_files_properties(src/trace/simd.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
# -O1 compiles in .7 of the time of -O3 here, and its code takes .77 to 1.1 of the time.
strahl_kernel(long_double "long double" -DSTRAHL_SCALAR -O1)
if(NOT STRAHL_LEVELS STREQUAL least)
  strahl_kernel(scalar "float;double" -DSTRAHL_SCALAR -O1)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  strahl_level(v2 -march=x86-64-v2)
  # Without these g++ copies structs in halves of a register, and large ones by `rep movs`, which takes long to start. A
  # load of a whole register has to wait for both.
  include(CheckCXXCompilerFlag)
  check_cxx_compiler_flag(-mmove-max=256 STRAHL_MOVE_MAX)
  if(STRAHL_MOVE_MAX)
    set(strahl_loop =vector_loop:65536:noalign,libcall:-1:noalign)
    set(strahl_copies -mmemcpy-strategy${strahl_loop} -mmemset-strategy${strahl_loop})
    set(strahl_moves -mmove-max=256 -mstore-max=256 ${strahl_copies})
  endif()
  strahl_level(v3 -march=x86-64-v3 ${strahl_moves})
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)  # clang's AVX-512 code for libstdc++ 12's packs gives wrong pictures
    # g++ 12 warns of an "uninitialized" operand inside its own AVX-512 header.
    strahl_level(v4 -march=x86-64-v4 -mprefer-vector-width=512 ${strahl_copies} -Wno-uninitialized
                  -Wno-maybe-uninitialized)
  endif()
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  strahl_kernel(neon "float;double" -Wno-psabi)  # g++ notes that packs were passed otherwise before its version 10
endif()
