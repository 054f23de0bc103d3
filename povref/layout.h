// The layout of POV-Ray text: blocks, comments, headings.
#pragma once
#include <string>
#include <vector>

namespace strahl {

/// "HEAD item item }" on one line if that fits into 100 columns, else with one item a line. Further lines begin with
/// `indent`.
std::string block(const std::string& head, const std::vector<std::string>& items, const std::string& indent = "");

/// `text` as comment lines that begin with `mark`.
std::string comment(const std::string& text, const std::string& mark = "//");

std::string heading(const std::string& text);

}  // namespace strahl
