// The formats that can be imported.
#pragma once
#include "import/builder.h"
#include "import/words.h"

namespace strahl {

/// E. Haines' Neutral File Format, version 3.1.
void read_nff(Words& words, Builder& scene);

/// Does the text start like a scene of Tachyon?
bool is_tachyon(Words& words);
/// J. Stone's Tachyon, version 0.99.
void read_tachyon(Words& words, Builder& scene);

}  // namespace strahl
