#include "pov/language/words.h"

#include "files/words.h"
#include "pov/language/value.h"

namespace strahl::pov {

std::string name_of_code(std::uint16_t code) {
    switch (code) {
        case end_code:
            return "the end of the scene";
        case number_code:
            return "a number";
        case string_code:
            return "a string";
        case new_name_code:
            return "an unknown name";
        case value_code:
            return "an identifier";
        case less_equal_code:
            return "'<='";
        case greater_equal_code:
            return "'>='";
        case not_equal_code:
            return "'!='";
    }
    if (code >= first_word_code) return strahl::quoted(reserved_words[code - first_word_code]);
    return strahl::quoted(std::string(1, static_cast<char>(code)));
}

const char* name_of(ValueKind kind) {
    static constexpr const char* names[]{"nothing",
                                         "a number",
                                         "a vector of two components",
                                         "a vector",
                                         "a vector of four components",
                                         "a colour",
                                         "a string",
                                         "an array",
                                         "a spline",
                                         "a function",
                                         "a function",
                                         "a macro",
                                         "a file",
                                         "a pigment",
                                         "a normal",
                                         "a finish",
                                         "a texture",
                                         "a material",
                                         "an interior",
                                         "a medium",
                                         "a density",
                                         "a colour map",
                                         "a map of pigments",
                                         "a map of normals",
                                         "a map of textures",
                                         "a map of densities",
                                         "a map of slopes",
                                         "a camera",
                                         "a transformation",
                                         "a fog",
                                         "a rainbow",
                                         "a sky sphere",
                                         "an object"};
    return names[static_cast<int>(kind)];
}

}  // namespace strahl::pov
