// Writes what is known about the words of the language as tables in Markdown.
#include "text/manual/manual.h"

#include <array>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "text/blocks/blocks.h"
#include "text/manual/word_help.h"

namespace strahl {
namespace {

std::string parameter_table(std::string_view block) {
    std::string table = "| parameter | default | values | meaning |\n|---|---|---|---|\n";
    for (const WordHelp& row : help_on_block(block))
        table += "| " + row.name + " | " + row.otherwise + " | " + row.values + " | " + row.meaning + " |\n";
    return table;
}

/// The rows of several blocks, each with its word in the first row.
template <std::size_t count>
std::string table_of(const std::array<std::string_view, count>& blocks, bool defaults) {
    std::string table = defaults ? "| pattern | parameter | default | values | meaning |\n|---|---|---|---|---|\n"
                                 : "| body | arguments | values | meaning |\n|---|---|---|---|\n";
    for (const std::string_view block : blocks) {
        std::string name = "`" + std::string(block) + "`";
        for (const WordHelp& row : help_on_block(block))
            table += "| " + std::exchange(name, "") + " | " + row.name + " | " +
                     (defaults ? row.otherwise + " | " : "") + row.values + " | " + row.meaning + " |\n";
    }
    return table;
}

std::map<std::string, std::string> all_tables() {
    std::map<std::string, std::string> tables{{"bodies", table_of(body_words, false)},
                                              {"patterns", table_of(pattern_words, true)}};
    each_block([&](const char* word, const auto&) { tables[word] = parameter_table(word); });
    return tables;
}

}  // namespace

std::string with_current_tables(const std::string& page) {
    const std::string begin = "<!-- table: ", begin_end = " -->\n", end = "<!-- end of table -->";
    std::map<std::string, std::string> tables = all_tables();
    std::string text;
    std::size_t at = 0;
    for (std::size_t start; (start = page.find(begin, at)) != page.npos;) {
        const std::size_t name = start + begin.size(), name_end = page.find(begin_end, name);
        const std::size_t close = page.find(end, name);
        if (name_end == page.npos || close == page.npos || close < name_end)
            throw std::runtime_error("a table of the manual has no '" + end + "'");
        const auto table = tables.extract(page.substr(name, name_end - name));
        if (!table) throw std::runtime_error("unknown or second table: " + page.substr(name, name_end - name));
        text += page.substr(at, name_end + begin_end.size() - at) + table.mapped();
        at = close;
    }
    if (!tables.empty()) throw std::runtime_error("the manual lacks the table '" + tables.begin()->first + "'");
    return text + page.substr(at);
}

}  // namespace strahl
