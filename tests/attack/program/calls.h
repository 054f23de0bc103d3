// Shared by the two parts of the preloaded library: fail.cpp, and calls.cpp with the file calls.
#pragma once
#include "fail.h"

namespace strahl::attack {

bool struck(Watched kind, const char* function);

/// Null in a program that is not attacked.
const Control* orders();

/// Opens the log, and makes what is printed go through the write() that is watched.
void prepare_files();

}  // namespace strahl::attack
