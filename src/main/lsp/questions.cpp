#include "main/lsp/questions.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>

#include "files/utf8.h"
#include "main/lsp/scene_names.h"
#include "pov/language/words.h"
#include "pov/open_scene.h"
#include "text/manual/word_help.h"
#include "text/reading/scene_files.h"
#include "text/reading/tracks_file.h"

namespace strahl {
namespace {

DocumentSlice slice_of(const std::shared_ptr<const Document>& document, std::string_view text) {
    return {document, static_cast<std::size_t>(text.data() - document->text.data()), text.size()};
}

/// Finds where the document gives a name: the last place before `before`, else the first one.
std::optional<DocumentSlice> find_name(const std::shared_ptr<const Document>& document, std::string_view name,
                                       std::size_t before) {
    std::optional<DocumentSlice> found;
    if (!document) return found;
    for (const SceneName& own : names_in(document->text))
        if (const DocumentSlice slice = slice_of(document, own.text);
            own.text == name && (!found || slice.at <= before))
            found = slice;
    return found;
}

}  // namespace

std::optional<DocumentSlice> definition_at(const EditedScene& scene, std::size_t at, const ReadDocument& read) {
    const Document& document = *scene.document;
    const SceneCursor cursor = cursor_at(document.text, at);
    const std::string_view text = cursor.at.text;
    if (cursor.at.kind == SceneToken::word) {
        if (const auto own = find_name(scene.document, text, at)) return own;
        for (const std::string& file : scene.files)
            if (const auto other = file == document.path ? std::nullopt : find_name(read(file), text, text.npos))
                return other;
    }
    if (cursor.at.kind != SceneToken::quotation) return {};
    if (cursor.before.text == "track") return find_name(read(tracks_path(document.path)), text, 0);
    const std::string name(text.substr(1, text.find_first_of("\"\r\n", 1) - 1));
    std::vector<std::string> paths{path_beside(document.path, name)};
    for (const std::string& file : scene.files)
        if (file.ends_with("/" + name)) paths.push_back(file);
    std::error_code error;
    for (const std::string& path : paths)
        if (std::filesystem::is_regular_file(path, error))
            return DocumentSlice{std::make_shared<const Document>(path, "")};
    return {};
}

std::string help_at(const EditedScene& scene, std::size_t at, const ReadDocument& read, DocumentSlice& word) {
    const SceneCursor cursor = cursor_at(scene.document->text, at);
    if (cursor.at.kind != SceneToken::word) return "";
    word = slice_of(scene.document, cursor.at.text);
    if (const auto found = definition_at(scene, at, read)) {
        const std::string_view line = found->document->line_at(found->at);
        return "```\n" + std::string(line.substr(0, forth(line, 0, line.size(), 120))) + "\n```";
    }
    return is_pov(scene.document->path) ? "" : help_on_word(cursor.at.text, cursor.block(), cursor.block(1));
}

std::vector<OfferedWord> words_at(const EditedScene& scene, std::size_t at, const ReadDocument& read) {
    const Document& document = *scene.document;
    const SceneCursor cursor = cursor_at(document.text, at);
    if (cursor.at.kind == SceneToken::comment || cursor.at.kind == SceneToken::quotation) return {};
    const bool pov = is_pov(document.path);
    const std::string_view block = cursor.block(), before = cursor.before.text;
    const bool of_material = before == "material" || before == "defaultmaterial";
    std::vector<std::string> words = words_after(block == "solid" && before == "{" ? block : before);
    if (words.empty() && !of_material) words = words_in(block, cursor.block(1));
    const bool bodies = std::ranges::find(words, "sphere") != words.end();
    std::vector<OfferedWord> offered;
    if (pov)
        for (const std::string_view word : pov::reserved_words)
            offered.push_back({OfferedWord::parameter, std::string(word)});
    else
        for (const std::string& word : words)
            offered.push_back({help_on_block(word).empty() ? OfferedWord::parameter : OfferedWord::block, word,
                               help_on_word(word, block, cursor.block(1))});
    std::set<std::string> names;
    const auto add_names = [&](std::string_view text) {
        for (const SceneName& name : names_in(text))
            if (pov || name.kind == SceneName::value || (name.kind == SceneName::material && of_material) ||
                (name.kind == SceneName::body && bodies))
                names.emplace(name.text);
    };
    add_names(document.text);
    for (const std::string& file : scene.files)
        if (const auto other = file == document.path ? nullptr : read(file)) add_names(other->text);
    for (const std::string& name : names) offered.push_back({OfferedWord::name, name});
    return offered;
}

}  // namespace strahl
