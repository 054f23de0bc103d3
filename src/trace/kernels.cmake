# The tracer: its plain part, and the kernel compiled once per instruction set. Kernels are optimised in every preset:
# an inline function that is not inlined would merge with another level's when linked.
strahl_module(trace src/trace strahl_scene)
get_target_property(strahl_trace_sources strahl_trace SOURCES)
list(FILTER strahl_trace_sources EXCLUDE REGEX "/kernel\\.cpp$")
set_property(TARGET strahl_trace PROPERTY SOURCES ${strahl_trace_sources})

function(strahl_kernel level)
  add_library(kernel_${level} OBJECT src/trace/kernel.cpp)
  target_link_libraries(kernel_${level} PRIVATE strahl_flags)
  target_compile_definitions(kernel_${level} PRIVATE STRAHL_LEVEL=${level})
  # Points-to analysis takes g++ 12 a third of its time here and finds nothing that makes the code faster; ordering
  # instructions before registers are shared out, which x86 does without by default, makes it 3 % faster.
  target_compile_options(kernel_${level} PRIVATE -O3
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-pta$<SEMICOLON>-fschedule-insns$<SEMICOLON>-fsched-pressure> ${ARGN})
  if(STRAHL_SANITIZE AND NOT level STREQUAL scalar)
    # Instrumented packs take g++ a quarter of an hour to compile. The scalar instance is the same text.
    set_target_properties(kernel_${level} PROPERTIES UNSANITIZED ON)
  elseif(STRAHL_SANITIZE)
    target_compile_options(kernel_${level} PRIVATE -O1)
  endif()
  target_sources(strahl_trace PRIVATE $<TARGET_OBJECTS:kernel_${level}>)
endfunction()

strahl_kernel(scalar -DSTRAHL_SCALAR)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  strahl_kernel(v2 -march=x86-64-v2)
  strahl_kernel(v3 -march=x86-64-v3)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)  # clang's AVX-512 code for libstdc++ 12's packs gives wrong pictures
    # g++ 12 warns of an "uninitialized" operand inside its own AVX-512 header.
    strahl_kernel(v4 -march=x86-64-v4 -mprefer-vector-width=512 -Wno-uninitialized -Wno-maybe-uninitialized)
  endif()
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  strahl_kernel(neon -Wno-psabi)  # g++ notes that packs were passed otherwise before its version 10
endif()
