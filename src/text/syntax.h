// Syntax highlighting of scene files in editors, made from the lists that the parser reads by.
#pragma once
#include <string>

namespace strahl {

/// A syntax file of vim.
std::string vim_syntax();
/// A TextMate grammar (JSON), which Visual Studio Code, Sublime Text, Kate's successors and others read.
std::string textmate_grammar();

}  // namespace strahl
