// The formats that can be imported.
#pragma once
#include "import/builder.h"
#include "import/word_reader.h"

namespace strahl {

/// E. Haines' Neutral File Format, version 3.1.
void read_nff(WordReader& words, SceneBuilder& scene);

/// Does the text start like a scene of Tachyon?
bool is_tachyon(WordReader& words);
/// J. Stone's Tachyon, version 0.99.
void read_tachyon(WordReader& words, SceneBuilder& scene);

}  // namespace strahl
