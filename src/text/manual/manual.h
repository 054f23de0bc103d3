// The tables of the manual, src/text/README.md, made from the lists that the parser reads by.
#pragma once
#include <string>

namespace strahl {

/// `page` with every table between `<!-- table: NAME -->` and `<!-- end of table -->` written anew. Throws
/// std::runtime_error if the page lacks a table, names an unknown one, or does not end one.
std::string with_current_tables(const std::string& page);

}  // namespace strahl
