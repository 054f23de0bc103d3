// The values that the information panel shows.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "show/session/session.h"
#include "show/work/pace.h"
#include "show/work/window_picture.h"

namespace strahl {

/// Names and values, line by line.
std::vector<std::pair<std::string, std::string>> info_lines(const Session& session, const Pace& pace,
                                                            const WindowPicture& picture);

}  // namespace strahl
