// Finds words, blocks and names in scene text that may be half written.
#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "text/reading/scene_tokens.h"

namespace strahl {

/// The token at a place of a text, or that ends there, the one before it, and the words that opened the blocks around
/// it, the outermost first.
struct SceneCursor {
    SceneToken at, before;
    std::vector<std::string_view> blocks;
    /// The word of the innermost block, or of one around it; empty if there is none.
    std::string_view block(std::size_t level = 0) const {
        return level < blocks.size() ? blocks[blocks.size() - 1 - level] : std::string_view();
    }
};
SceneCursor cursor_at(std::string_view text, std::size_t at);

/// A name that a text gives to something: by `define`, #declare, #local, #macro, as a parameter of a macro or by #for;
/// or to a track of a file of tracks.
struct SceneName {
    enum NameKind { material, body, value, track } kind;
    std::string_view text;  // the name where it is given
};
std::vector<SceneName> names_in(std::string_view text);

/// A block of the top level, with the word that opens it, or what a declaration of the top level names.
struct SceneBlock {
    std::string_view name, whole;  // `whole` reaches to the closing brace, if the block has one
    bool declared = false;
};
std::vector<SceneBlock> blocks_in(std::string_view text);

}  // namespace strahl
