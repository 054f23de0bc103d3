// Answers an editor's questions about a place in a scene: help, words to complete, and where a name is given.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "main/lsp/document.h"

namespace strahl {

/// A scene that an editor has open, and the files that its last check without errors has read.
struct EditedScene {
    std::shared_ptr<const Document> document;
    std::vector<std::string> files{};
};
/// Returns the text of a file, as an editor has it or else the disk; null if it cannot be read.
using ReadDocument = std::function<std::shared_ptr<const Document>(const std::string& path)>;

/// A slice of a document.
struct DocumentSlice {
    std::shared_ptr<const Document> document;
    std::size_t at = 0, size = 0;
};

/// Finds what the word or the text in quotes at a place stands for: a name, a track, or a file, of which it returns the
/// start.
std::optional<DocumentSlice> definition_at(const EditedScene& scene, std::size_t at, const ReadDocument& read);

/// Describes the word at a place in Markdown: the line that gives a name, or the manual's rows. Empty if there is
/// nothing to say. `word` becomes the slice of the word.
std::string help_at(const EditedScene& scene, std::size_t at, const ReadDocument& read, DocumentSlice& word);

/// A word that may stand at a place.
struct OfferedWord {
    enum OfferKind { name, block, parameter } kind;
    std::string word, help{};
};
/// Returns the words of the language that may stand at a place, in a .pov all, and the names that the scene and the
/// files that it includes have given.
std::vector<OfferedWord> words_at(const EditedScene& scene, std::size_t at, const ReadDocument& read);

}  // namespace strahl
