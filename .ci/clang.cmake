# Compiles with clang, from 16 on: older ones lack what src uses. With sanitizers it takes .6 of g++'s time.
find_program(CMAKE_CXX_COMPILER NAMES clang++-19 clang++-18 clang++-17 clang++-16 clang++ REQUIRED)
