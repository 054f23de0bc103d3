// Lays out POV-Ray text: blocks, comments, headings.
#pragma once
#include <string>
#include <vector>

namespace strahl {

/// Returns "HEAD item item }" on one line if that fits into 100 columns and HEAD is one line, else with one item a
/// line. Further lines begin with `indent`. Empty items are left out.
std::string block(const std::string& head, std::vector<std::string> items, const std::string& indent = "");

/// Returns `words` as comment lines that begin with `mark`. A line break in `words` does not end the comment.
std::string comment(const std::string& words, const std::string& mark = "//");

std::string heading(const std::string& text);

}  // namespace strahl
