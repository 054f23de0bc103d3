#include "import/import.h"

#include "files/error.h"
#include "files/utf8.h"
#include "import/builder.h"
#include "import/formats.h"
#include "import/word_reader.h"
#include "text/blocks/blocks.h"
#include "text/reading/lexer.h"
#include "text/reading/other_files.h"

namespace strahl {
namespace {

/// Returns whether a file is a scene of this program: by its name, or by its first word.
bool is_own(std::string_view text, std::string_view file) {
    Diagnostics diagnostics(text, file);
    const std::string_view word = Lexer(text, diagnostics).word();
    return file.ends_with(".rt") || contains(block_words, word);
}

}  // namespace

Imported import_scene(std::string_view text, std::string_view file, const ImportLimits& limits) {
    text = utf8_text(text, file);
    refuse_other_files(text, file);
    if (is_own(text, file))
        throw FileError(show(file).text + " is a scene in Strahl's own language; there is nothing to convert");
    WordReader words(text, file);
    SceneBuilder builder(words, limits);
    if (is_tachyon(words))
        read_tachyon(words, builder);
    else
        read_nff(words, builder);
    return builder.finish(show(file).text);
}

}  // namespace strahl
