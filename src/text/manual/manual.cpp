// Writes field tables and parameter lists as tables in Markdown.
#include "text/manual/manual.h"

#include <map>
#include <span>
#include <stdexcept>
#include <type_traits>

#include "num/decimal.h"
#include "text/blocks/blocks.h"

namespace strahl {
namespace {

std::string code(std::string_view word) { return std::string("`").append(word).append("`"); }

/// The default of a parameter in words; `instead_of` is the parameter that it can replace, or empty.
std::string default_of(const Parameter& parameter, std::string_view instead_of) {
    if (!instead_of.empty()) return "in place of " + code(instead_of);
    if (!parameter.otherwise.empty()) return std::string(parameter.otherwise);
    return std::visit(
        [](const auto* value) -> std::string {
            if constexpr (requires { text_of(*value); })
                return code(text_of(*value));
            else
                return "none";
        },
        parameter.value);
}

std::string parameter_table(std::span<const Parameter> parameters) {
    std::string table = "| parameter | default | values | meaning |\n|---|---|---|---|\n";
    std::string_view before, offers;  // the parameter above and its alternative
    for (const Parameter& p : parameters) {
        const bool word_alone = std::holds_alternative<bool*>(p.value);
        table += "| " + code(p.name) + " | " + default_of(p, p.name == offers ? before : "") + " | " +
                 (word_alone ? "the word alone" : p.range.words) + " | " + p.help + " |\n";
        before = p.name, offers = p.alternative;
    }
    return table;
}

template <class Kind>
std::string body_rows() {
    std::string rows, name = code(Kind::name);
    const auto add = [&](const auto& field) {
        rows += "| " + name + " | " +
                (field.given == Given::optional ? "[" + std::string(field.name) + "]" : field.name) + " | " +
                argument_range(field.range).words + " | " + field.help + " |\n";
        name = "";
    };
    std::apply([&](const auto&... field) { (add(field), ...); }, Kind::fields);
    return rows;
}
template <>
std::string body_rows<Mesh>() {
    return "| `mesh` | file \"NAME\" | a path, relative to the scene's folder | a PLY, OBJ or STL file of triangles |\n"
           "|  | triangle, smooth_triangle | blocks with the arguments above | any number of them, in place of a file "
           "|\n";
}
template <class Kind>
requires is_composite<Kind> std::string body_rows() {
    const char* const what = Kind::operation == Operation::unite       ? "all points in at least one of them"
                             : Kind::operation == Operation::intersect ? "all points in all of them"
                                                                       : "all points in the first and in no other";
    return "| " + code(Kind::name) + " | bodies | blocks of closed bodies | " + what + " |\n";
}
template <class... Kinds>
std::string body_table(std::type_identity<std::variant<Kinds...>>) {
    return "| body | arguments | values | meaning |\n|---|---|---|---|\n" + (body_rows<Kinds>() + ...);
}

void image_rows(const auto& add) {
    add("\"NAME\"", "required", "a path, relative to the scene's folder", ImagePattern::help);
    add("`once`", "it repeats", not_negative.words, "the picture is there once, with this colour around it");
}

template <class Kind>
std::string pattern_rows() {
    std::string rows, name = code(Kind::name);
    const auto add = [&](const std::string& parameter, const std::string& otherwise, const char* values,
                         const std::string& help) {
        rows += "| " + name + " | " + parameter + " | " + otherwise + " | " + values + " | " + help + " |\n";
        name = "";
    };
    if constexpr (two_colored<Kind>)
        add("two colours", "required", not_negative.words, Kind::help);
    else if constexpr (requires { Kind().solid; })
        add("its name", "required", "see above", Kind::help), add("`colors`", "required", "see above", "the colours");
    else if constexpr (has_map<Kind>)
        add("`colors`", "required", "see above", Kind::help);
    else
        image_rows(add);
    Kind kind;
    std::vector<std::string> codes;
    for (const std::string_view map : maps_of(kind)) codes.push_back(code(map));
    const std::string maps = listed(codes);
    add("`map`", codes.size() == 1 ? "the body's points" : code(image_maps[0]), maps.c_str(),
        "how the pattern is laid onto the body");
    if constexpr (std::tuple_size_v < decltype(Kind::fields) >> 0)
        for (const Parameter& p : field_parameters(kind))
            add(code(p.name), default_of(p, ""), p.range.words, p.help);
    return rows;
}
template <class... Kinds>
std::string pattern_table(std::type_identity<std::variant<Kinds...>>) {
    return "| pattern | parameter | default | values | meaning |\n|---|---|---|---|---|\n" +
           (pattern_rows<Kinds>() + ...);
}

std::map<std::string, std::string> all_tables() {
    std::map<std::string, std::string> tables{{"bodies", body_table(std::type_identity<Shape>{})},
                                              {"patterns", pattern_table(std::type_identity<PatternKind>{})}};
    each_block([&](const char* word, const auto& parameters) { tables[word] = parameter_table(parameters); });
    tables["music"] += "| " + code(music_words[0]) + " \"NAME\" | none | a path, relative to the scene's folder | " +
                       "an Ogg Vorbis file, mono or stereo |\n";
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
