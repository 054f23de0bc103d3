// The layout of POV-Ray text: blocks, comments, headings.
#pragma once
#include <string>
#include <vector>

namespace strahl {

/// "HEAD item item }" on one line if that fits into 100 columns and HEAD is one, else with one item a line. Further
/// lines begin with `indent`.
std::string block(const std::string& head, const std::vector<std::string>& items, const std::string& indent = "");

/// `words` as comment lines that begin with `mark`; no line break in them ends the comment.
std::string comment(const std::string& words, const std::string& mark = "//");

std::string heading(const std::string& text);

}  // namespace strahl
