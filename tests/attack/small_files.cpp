// Spoilt files for the small readers, each given to all of them.
#include <algorithm>
#include <iterator>

#include "files/regular_file.h"
#include "image/band_file.h"
#include "tests/attack/file_attack.h"
#include "tests/attack/mutator.h"
#include "tests/attack/readers.h"
#include "tests/unit/scratch.h"

using namespace strahl;

namespace {

std::string checkpoint() {
    const Scratch folder;
    const std::string path = folder / "a.checkpoint";
    BandHeader header;
    header.program = "1", header.scene = "2", header.options = "3", header.ending = ".png";
    header.layout.width = 8, header.layout.height = 100, header.layout.channels = 3, header.layout.bits = 8;
    BandFile bands(path, header);
    bands.append(1, {std::string(100, 'b'), "note"});
    bands.append(0, {"short", ""});
    return bytes_of(path);
}

std::vector<std::string> valid_files() {
    const std::string keys(1, '\0'), three(3, '\0');
    const std::string rocket = keys + three + "\2" + three + "\7\x3f\x80" + three + "\3" + three + "\x9\4\1\5" + "\1" +
                               three + "\2" + three + "\7";
    return {"track \"a\" {\n  0 1.5 step\n  8 -2 linear // a comment\n 9 1e3 smooth\n}\ntrack \"b:c\" { 4 0 ramp }\n",
            rocket, bytes_of(STRAHL_SOURCE "/tests/window/clicks.ogg").substr(0, 20000), checkpoint(),
            "100 200 1280 720\n"};
}

class SmallFileMutator : Mutator {
  public:
    using Mutator::Mutator;
    std::string mutated() {
        file = any();
        for (std::size_t i = 1 + below(5); i > 0 && !file.empty(); --i) {
            const std::size_t at = below(file.size()), length = 1 + below(std::min<std::size_t>(file.size() - at, 30));
            if (below(3) == 0)
                file.replace(at, below(4), words[below(std::size(words))]);
            else
                change_bytes(static_cast<Change>(below(5)), at, length, [&] { return below(file.size()); });
        }
        return file;
    }

  private:
    static constexpr const char* words[]{"}",     "}\n}", "{",  "track ",       "\"", " 1e9 ",
                                         "step ", "/*",   "//", "\xEF\xBB\xBF", "\n"};
};

std::string mutated_file(const std::vector<std::string>& valid, std::uint64_t number) {
    return SmallFileMutator(valid, number).mutated();
}

void read(const std::string& path) {
    const RegularFile file(path);
    const std::string bytes = file.bytes(0, file.size());
    for (const AttackedReader& reader : attacked_readers)
        if (path.ends_with(reader.ending)) reader.read(bytes);
}

}  // namespace

int main(int count, char** arguments) {
    std::vector<const char*> endings;
    for (const AttackedReader& reader : attacked_readers) endings.push_back(reader.ending);
    return run_attack({"small_file", endings, valid_files, mutated_file, read}, count, arguments);
}
