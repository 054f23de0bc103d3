// Keeps programs from writing files.
#pragma once
#include <string>

namespace strahl::os {

/// From now on this thread, and all programs that it starts, can make, change and remove files only below `folder`;
/// reading stays as it is. Throws std::runtime_error where the kernel cannot do that: Linux can from 5.13 on.
void write_only_below(const std::string& folder);

}  // namespace strahl::os
