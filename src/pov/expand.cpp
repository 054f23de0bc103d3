#include "pov/expand.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <utility>

#include "num/decimal.h"
#include "pov/language/interpreter.h"
#include "text/reading/scene_tokens.h"

namespace strahl::pov {
namespace {

constexpr std::size_t most_bytes = std::size_t(256) << 20;

/// Declarations of scene text have values only: no bodies, textures or cameras.
struct ValuesAlone final : SceneLayer {
    NamedValue read_thing(Interpreter&) override { return {}; }
    void read_default(Interpreter& in) override { in.fail("'#default' means nothing here: use 'defaultmaterial'"); }
    std::shared_ptr<const FunctionThing> read_function(Interpreter& in) override { in.expected("an expression"); }
    bool trace(Interpreter& in, const Thing&, const DVec3&, const DVec3&, DVec3&, DVec3&) override {
        in.fail("bodies cannot be asked here");
    }
    bool inside(Interpreter& in, const Thing&, const DVec3&) override { in.fail("bodies cannot be asked here"); }
    std::pair<DVec3, DVec3> extent(Interpreter& in, const Thing&) override { in.fail("bodies cannot be asked here"); }
};

bool is_part_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
std::size_t word_length(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::find_if_not(text, is_part_of_word) - text.begin());
}

std::string written(const Components& value) {
    if (value.count == 1) return text_of(value.value[0]);
    // Writes three numbers of a colour that lets nothing through.
    const int count = value.count == 5 && value.value[3] == 0 && value.value[4] == 0 ? 3 : value.count;
    std::string text = "<";
    for (int i = 0; i < count; ++i) text += (i > 0 ? ", " : "") + text_of(value.value[static_cast<std::size_t>(i)]);
    return text + ">";
}

/// Does an expression come next, and no word of scene text? `rest` is the text from there on.
bool at_value(Interpreter& in, std::string_view rest) {
    if (!in.at_expression()) return false;
    if (rest.starts_with('<')) {  // a vector whose numbers follow tracks is read number by number
        const std::string_view inside = rest.substr(0, rest.find('>'));
        return inside.find("track") == inside.npos;
    }
    // `pow` is a word of materials, too.
    const std::size_t length = word_length(rest), next = rest.find_first_not_of(" \t", length);
    return rest.substr(0, length) != "pow" || (next != rest.npos && rest[next] == '(');
}

}  // namespace

bool has_directives(std::string_view text) {
    if (text.find('#') == text.npos) return false;
    SceneTokens tokens(text);
    for (SceneToken token; (token = tokens.next()).kind != SceneToken::none;) {
        if (token.text[0] != '#') continue;
        const std::string_view rest(token.text.data() + 1, text.data() + text.size());
        const std::string_view behind = rest.substr(std::min(rest.find_first_not_of(" \t"), rest.size()));
        if (is_directive(behind.substr(0, word_length(behind)))) return true;
    }
    return false;
}

ExpandedText expand(std::string text, const InterpreterOptions& options) {
    ValuesAlone layer;
    ExpandedText all;
    Interpreter in(std::move(text), options, layer);
    std::map<std::uint32_t, std::pair<const std::string*, const std::string*>> known;  // names and texts of files
    const auto source = [&](TextPlace place) {
        auto [entry, is_new] = known.try_emplace(place.file);
        if (is_new) {
            for (std::string own : {in.path_of(place), std::string(in.text_at({place.file, 0}))})
                all.sources.push_back(std::make_unique<std::string>(std::move(own)));
            entry->second = {all.sources.end()[-2].get(), all.sources.back().get()};
        }
        return entry->second;
    };
    while (!in.at_end()) {
        const TextPlace place = in.place();
        const std::string_view rest = in.text_at(place);
        const auto [path, whole] = source(place);
        all.text += '\n';
        all.origins.push_back({all.text.size(), *path, *whole, place.at});
        if (at_value(in, rest)) {
            all.text += written(in.read_components());
        } else if (in.at_string()) {
            all.text += '"' + in.read_file_name() + '"';
        } else {
            all.text += rest.substr(0, std::max<std::size_t>(word_length(rest), 1));
            in.take();
        }
        if (all.text.size() > most_bytes)
            in.fail(place, "the scene is longer than 256 MiB once its directives have been executed");
    }
    all.files = in.files();
    return all;
}

}  // namespace strahl::pov
