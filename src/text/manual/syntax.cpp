#include "text/manual/syntax.h"

#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>

#include "text/blocks/blocks.h"

namespace strahl {

LanguageWords words_of_language() {
    LanguageWords words;
    const auto add = [](std::set<std::string>& to, const auto& from) {
        for (const std::string_view word : from) to.emplace(word);
    };
    add(words.blocks, block_words), add(words.blocks, mesh_words);
    add(words.patterns, pattern_words);
    add(words.others, shape_words), add(words.others, triangle_words), add(words.others, maps_of(ImagePattern()));
    add(words.others, image_wraps);
    add(words.others, light_words), add(words.others, music_words);
    add(words.others,
        std::initializer_list<std::string_view>{"colors", "map", "once", "wrap", "sharp", "height", "none", "track"});
    add(words.others, opacity_words);
    const auto add_fields = [&](const auto& fields) {
        std::apply([&](const auto&... field) { (words.others.emplace(field.name), ...); }, fields);
    };
    [&]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
        (add_fields(Kinds::fields), ...);
    }(std::type_identity<PatternKind>());
    each_block([&](const char* word, const auto& parameters) {
        words.blocks.emplace(word);
        for (const Parameter& parameter : parameters) words.others.emplace(parameter.name);
    });
    for (const std::string& word : words.blocks) words.others.erase(word);
    return words;
}

std::string vim_syntax() {
    const LanguageWords words = words_of_language();
    return "\" Scenes of Strahl, *.rt.\nif exists(\"b:current_syntax\")\n  finish\nendif\n"
           "syn keyword strahlBlock " +
           listed(words.blocks, " ") + "\nsyn keyword strahlParameter " + listed(words.others, " ") +
           "\nsyn keyword strahlPattern " + listed(words.patterns, " ") +
           "\nsyn match strahlNumber \"[-+]\\?\\%(\\d\\+\\.\\?\\d*\\|\\.\\d\\+\\)\\%([eE][-+]\\?\\d\\+\\)\\?\"\n"
           "syn region strahlString start=+\"+ end=+\"+ oneline\n"
           "syn match strahlComment \"//.*$\" contains=@Spell\n"
           "syn region strahlComment start=\"/\\*\" end=\"\\*/\" contains=@Spell\n"
           "hi def link strahlBlock Structure\nhi def link strahlParameter Identifier\n"
           "hi def link strahlPattern Function\nhi def link strahlNumber Number\n"
           "hi def link strahlString String\nhi def link strahlComment Comment\n"
           "setlocal commentstring=//\\ %s\nlet b:current_syntax = \"strahl\"\n";
}

std::string textmate_grammar() {
    const LanguageWords words = words_of_language();
    const auto rule = [](const char* name, const std::string& match) {
        return std::string("    { \"name\": \"") + name + ".strahl\", \"match\": \"" + match + "\" },\n";
    };
    const auto any = [](const std::set<std::string>& all) { return "\\\\b(" + listed(all, "|") + ")\\\\b"; };
    return "{\n  \"name\": \"Strahl scene\",\n  \"scopeName\": \"source.strahl\",\n  \"fileTypes\": [\"rt\"],\n"
           "  \"patterns\": [\n" +
           rule("comment.line.double-slash", "//.*$") +
           "    { \"name\": \"comment.block.strahl\", \"begin\": \"/\\\\*\", \"end\": \"\\\\*/\" },\n" +
           rule("string.quoted.double", "\\\"[^\\\"]*\\\"") + rule("storage.type", any(words.blocks)) +
           rule("support.function", any(words.patterns)) + rule("variable.parameter", any(words.others)) +
           "    { \"name\": \"constant.numeric.strahl\", "
           "\"match\": \"[-+]?(\\\\d+\\\\.?\\\\d*|\\\\.\\\\d+)([eE][-+]?\\\\d+)?\" }\n  ]\n}\n";
}

}  // namespace strahl
