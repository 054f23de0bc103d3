// Syntax highlighting of scene files in editors, made from the lists that the parser reads by.
#pragma once
#include <set>
#include <string>

namespace strahl {

/// Every word of the language, once: those that open blocks, the patterns, and all others.
struct LanguageWords {
    std::set<std::string> blocks, patterns, others;
};
LanguageWords words_of_language();

/// A syntax file of vim.
std::string vim_syntax();
/// A TextMate grammar (JSON), which Visual Studio Code, Sublime Text, Kate's successors and others read.
std::string textmate_grammar();

}  // namespace strahl
