#include "text/reading/advice.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "files/words.h"
#include "scene/material.h"

namespace strahl {
namespace {

/// A word of another language, the word of this one that does its work, and what to say: by default "use" that word.
struct Foreign {
    std::string_view word, own, advice = {};
};

constexpr std::string_view in_body = "it belongs inside the braces of a body",
                           in_flight = "it belongs in 'flythrough { ... }'";
constexpr std::string_view colour = "use 'material { rgb <r, g, b> }'", in_material = "use 'material { ... }'",
                           numbers = "colours are numbers, as in rgb <1, 0, 0>";
constexpr std::array foreign{
    // In a body. The words of a material follow by themselves.
    Foreign{"color", "material", colour},
    Foreign{"colour", "material", colour},
    Foreign{"pigment", "material", colour},
    Foreign{"texture", "material", colour},
    Foreign{"rgbt", "material", colour},
    Foreign{"rgbf", "material", colour},
    Foreign{"rgbft", "material", colour},
    Foreign{"finish", "material", in_material},
    Foreign{"interior", "material", in_material},
    Foreign{"transmit", "material", "use 'material { refraction ... }'"},
    Foreign{"filter", "material", "use 'material { refraction ... }'"},
    Foreign{"phong", "material", "use 'material { specular ... }'"},
    Foreign{"matrix", "material", "use 'scale', 'rotate' and 'translate'"},
    Foreign{"transform", "material", "use 'scale', 'rotate' and 'translate'"},
    // In a material.
    Foreign{"color", "rgb"},
    Foreign{"colour", "rgb"},
    Foreign{"pigment", "rgb"},
    Foreign{"texture", "rgb"},
    Foreign{"rgbt", "rgb", "use 'rgb', and 'refraction' for what is transmitted"},
    Foreign{"rgbf", "rgb", "use 'rgb', and 'refraction' for what is transmitted"},
    Foreign{"rgbft", "rgb", "use 'rgb', and 'refraction' for what is transmitted"},
    Foreign{"finish", "rgb", "leave it out: its values stand in 'material' itself"},
    Foreign{"interior", "rgb", "leave it out: 'ior' stands in 'material' itself"},
    Foreign{"phong", "specular"},
    Foreign{"phong_size", "pow"},
    Foreign{"shininess", "pow"},
    Foreign{"transmit", "refraction"},
    Foreign{"filter", "refraction"},
    Foreign{"transparency", "refraction"},
    Foreign{"opacity", "refraction"},
    Foreign{"alpha", "refraction"},
    Foreign{"emission", "ambient"},
    // In a pattern's place.
    Foreign{"red", "checker", numbers},
    Foreign{"green", "checker", numbers},
    Foreign{"blue", "checker", numbers},
    Foreign{"white", "checker", numbers},
    Foreign{"black", "checker", numbers},
    Foreign{"yellow", "checker", numbers},
    // Bodies.
    Foreign{"ball", "sphere"},
    Foreign{"cube", "box"},
    Foreign{"tube", "cylinder"},
    Foreign{"ground", "plane"},
    Foreign{"lamp", "light"},
    // In a camera, a light, and at the top level.
    Foreign{"location", "position"},
    Foreign{"eye", "position"},
    Foreign{"from", "position"},
    Foreign{"right", "aspectratio", "use 'aspectratio', or leave it out: the picture's own is taken"},
    Foreign{"direction", "look_at", "use 'look_at'"},
    Foreign{"rgb", "color"},
    Foreign{"area_light", "edges"},
    Foreign{"point_at", "look_at"},
    Foreign{"sky_sphere", "background"},
    Foreign{"declare", "define"},
    Foreign{"merge", "union"},
    Foreign{"object", "define", "use the defined name itself"},
    // At the top level only, where there are bodies.
    Foreign{"material", "defaultmaterial", in_body},
    Foreign{"scale", "defaultmaterial", in_body},
    Foreign{"rotate", "defaultmaterial", in_body},
    Foreign{"translate", "defaultmaterial", in_body},
    Foreign{"motion", "defaultmaterial", in_body},
    Foreign{"rgb", "defaultmaterial", "it belongs in 'material { ... }'"},
    Foreign{"key", "flythrough", in_flight},
    Foreign{"duration", "flythrough", in_flight},
    Foreign{"track", "flythrough", "it stands in place of a number, as in translate <0, 0, track \"height\">"},
};

/// Does a text begin with a colour of web pages, such as ff0000 or f00?
bool is_hexadecimal(std::string_view text) {
    const std::size_t digits = std::min(text.find_first_not_of("0123456789abcdefABCDEF"), text.size());
    const bool ends = digits == text.size() || !is_letter(text[digits]);
    return ends && (digits == 3 || digits == 6 || digits == 8);
}

}  // namespace

std::string advice_on_word(std::string_view word, std::span<const std::string_view> known) {
    const auto is_known = [&](std::string_view own) { return std::ranges::find(known, own) != known.end(); };
    if (is_known(word)) return "";
    const auto is_field = [&](const auto&... field) { return ((word == field.name) || ...); };
    if (is_known("material") && std::apply(is_field, Material::fields))
        return "use 'material { " + std::string(word) + " ... }'";
    for (const Foreign& row : foreign)
        if (row.word == word && is_known(row.own))
            return row.advice.empty() ? "use " + quoted(row.own) : std::string(row.advice);
    return "";
}

std::string advice_on_sign(std::string_view text, std::size_t at) {
    const auto is_digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
    const auto is_letter = [&](std::size_t i) {
        return i < text.size() && ((lower(text[i]) >= 'a' && lower(text[i]) <= 'z') || text[i] == '_');
    };
    const char sign = at < text.size() ? text[at] : '\0';
    // The last character before it that is no blank.
    std::size_t before = at;
    while (before > 0 && (text[before - 1] == ' ' || text[before - 1] == '\t')) --before;
    const bool after_number = before > 0 && (is_digit(before - 1) || text[before - 1] == '.');
    const bool directly = after_number && before == at;
    if (sign == ',' && directly) {
        // In <0,5, 1, 2> blanks tell the commas of the vector from that of the number; <0,5,1,2> has a number too many.
        const std::size_t open = text.substr(0, at).find_last_of("<>{}");
        const bool in_vector = open != text.npos && text[open] == '<';
        bool within = is_digit(at + 1);  // a comma between two digits
        for (std::size_t i = open + 1; in_vector && i < at; ++i)
            within |= text[i] == ',' && is_digit(i - 1) && is_digit(i + 1);
        if (within && (!in_vector || text.substr(open, text.find('>', at) - open).find(", ") != text.npos))
            return "decimals have a point, as in 2.5";
    }
    if (is_digit(at) && after_number && !directly) {  // <0,5 1 2>, but not <0,5 1>, which lacks a comma
        const std::size_t open = text.substr(0, at).find_last_of("<>{}"),
                          end = std::min(text.find('>', at), text.size());
        int numbers = 0;
        for (std::size_t i = open + 1; open != text.npos && text[open] == '<' && i < end; ++i)
            numbers += is_digit(i) && !is_digit(i - 1) && text[i - 1] != '.';
        if (numbers > 3) return "decimals have a point, as in 2.5";
    }
    const std::string_view head = text.substr(0, before);
    if (is_digit(at) && head.ends_with("rotate")) return "degrees about each axis, as in rotate <0, 0, 45>";
    if (sign == '"') {
        if (head.ends_with("mesh {")) return "a mesh of a file is written mesh { file \"NAME\" }";
        if (head.ends_with(" image")) return "an image is written image { \"NAME\" }";
    }
    if (sign == '#' && at + 1 < text.size() && is_hexadecimal(text.substr(at + 1)))
        return "colours are numbers, as in rgb <1, 0, 0>";
    if (sign == '#' && (text.substr(at + 1).starts_with("declare") || text.substr(at + 1).starts_with("local")))
        return "'define NAME material { ... }' and 'define NAME sphere { ... }' name a material and a body";
    if (sign == '#' || sign == ';') return "a comment begins with //, and nothing ends with ';'";
    const bool spaced_sign =
        (sign == '+' || sign == '-') && after_number && at + 1 < text.size() && text[at + 1] == ' ';
    std::size_t end = at;
    while (is_letter(end) || (end > at && is_digit(end))) ++end;
    const bool called = end > at && end < text.size() && text[end] == '(';
    const bool operation = (sign == '*' || sign == '/' || sign == '^') && after_number;
    if (operation || sign == '(' || called || spaced_sign || ((sign == '+' || sign == '-') && directly))
        return "expressions are calculated only in a text with a directive such as #declare; write the result";
    return "";
}

}  // namespace strahl
