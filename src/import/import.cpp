#include "import/import.h"

#include "files/utf8.h"
#include "import/builder.h"
#include "import/formats.h"
#include "import/word_reader.h"

namespace strahl {

Imported import_scene(std::string_view text, std::string_view file, const ImportLimits& limits) {
    WordReader words(text, file);
    SceneBuilder builder(words, limits);
    if (is_tachyon(words))
        read_tachyon(words, builder);
    else
        read_nff(words, builder);
    return builder.finish(show(file).text);
}

}  // namespace strahl
