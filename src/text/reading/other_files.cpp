#include "text/reading/other_files.h"

#include <algorithm>
#include <array>
#include <string>

#include "files/error.h"
#include "files/utf8.h"
#include "files/words.h"

namespace strahl {
namespace {

using namespace std::string_view_literals;

/// The bytes at `offset` of a kind of file (file(1) has them all).
struct Signature {
    std::string_view bytes, kind;
    std::size_t offset = 0;
};
constexpr std::string_view picture = "a picture", film = "a film", sound = "a sound", packed = "an archive";
constexpr std::array signatures{
    Signature{"\x89PNG", picture},
    Signature{"\xFF\xD8\xFF", picture},
    Signature{"GIF8", picture},
    Signature{"\x76\x2f\x31\x01", picture},
    Signature{"II*\0"sv, picture},
    Signature{"MM\0*"sv, picture},
    Signature{"#?RADIANCE", picture},
    Signature{"WEBP", picture, 8},
    Signature{"8BPS", picture},
    Signature{"ftypavif", picture, 4},
    Signature{"ftyp", film, 4},
    Signature{"\x1A\x45\xDF\xA3", film},
    Signature{"YUV4MPEG2", film},
    Signature{"AVI ", film, 8},
    Signature{"OggS", sound},
    Signature{"fLaC", sound},
    Signature{"ID3", sound},
    Signature{"WAVE", sound, 8},
    Signature{"PK\3\4", packed},
    Signature{"\x1F\x8B", packed},
    Signature{"\xFD"
              "7zXZ",
              packed},
    Signature{"BZh", packed},
    Signature{"\x28\xB5\x2F\xFD", packed},
    Signature{"7z\xBC\xAF", packed},
    Signature{"\x7F"
              "ELF",
              "a program"},
    Signature{"%PDF-", "a document"},
};

/// Returns whether this begins a PBM, PGM, PPM (P1 to P6), PFM or BMP picture, whose signatures have only two letters.
bool is_plain_picture(std::string_view bytes) {
    if (bytes.size() < 4) return false;
    if (bytes[0] == 'B' && bytes[1] == 'M') return find_invalid(bytes.substr(0, 54)) != bytes.npos;
    const bool letter = (bytes[1] >= '1' && bytes[1] <= '6') || bytes[1] == 'F' || bytes[1] == 'f';
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    return bytes[0] == 'P' && letter && is_space(bytes[2]) && (digit(bytes[3]) || bytes[3] == '#');
}

bool ends_with(std::string_view file, std::string_view ending) {
    return file.size() > ending.size() && same_word(file.substr(file.size() - ending.size()), ending);
}

}  // namespace

void refuse_other_files(std::string_view bytes, std::string_view file) {
    const std::string name = show(file).text;
    const auto fits = [&](const Signature& own) {
        return bytes.size() >= own.offset && bytes.substr(own.offset).starts_with(own.bytes);
    };
    const auto* const known = std::ranges::find_if(signatures, fits);
    if (known != signatures.end() || is_plain_picture(bytes))
        throw FileError(name + " is " + std::string(known != signatures.end() ? known->kind : picture) +
                        ", not a scene");
    for (const std::string_view ending : {".obj", ".ply", ".stl"})
        if (ends_with(file, ending))
            throw FileError(name + " is a mesh, not a scene; a scene shows it by mesh { file \"" + name + "\" }");
}

void refuse_other_scenes(std::string_view bytes, std::string_view file) {
    const std::string name = show(file).text;
    if (ends_with(file, ".nff") || bytes.starts_with("BEGIN_SCENE"))
        throw FileError(name + " is a scene of another program; convert it first: strahl import " + name +
                        " -o SCENE.rt");
}

}  // namespace strahl
