#include "import/models/mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "files/error.h"
#include "files/utf8.h"
#include "files/words.h"
#include "import/models/model.h"
#include "num/decimal.h"

namespace strahl {
namespace {

/// Reads the words of a line.
class MtlLine {
  public:
    MtlLine(std::string_view line, const std::string& path, std::size_t number)
        : rest_(line), path(path), number(number) {}

    std::string_view next() {
        skip();
        const std::size_t end = std::min(rest_.find_first_of(" \t"), rest_.size());
        const std::string_view word = rest_.substr(0, end);
        rest_.remove_prefix(end);
        return word;
    }
    std::string_view rest() {
        skip();
        return rest_;
    }
    bool ended() { return rest().empty(); }
    bool at_number() {
        MtlLine ahead = *this;
        double value = 0;
        return read_number(ahead.next(), value);
    }
    double value(const std::string& of) {
        const std::string_view word = next();
        double value = 0;
        if (word.empty()) fail("the line ends where a number for '" + of + "' should be");
        if (!read_number(word, value) || !(std::abs(value) <= 1e9))
            fail(quoted(word) + " should be a number from -1e9 to 1e9, for '" + of + "'");
        return value;
    }
    /// Three numbers, or one for all.
    DVec3 values(const std::string& of) {
        DVec3 all(value(of));
        if (at_number()) all.y = value(of), all.z = at_number() ? value(of) : 1;
        return all;
    }
    [[noreturn]] void fail(const std::string& message) const {
        throw FileError(path + ":" + std::to_string(number) + ": " + message);
    }

  private:
    void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t"), rest_.size())); }

    std::string_view rest_;
    const std::string& path;
    std::size_t number;
};

MtlPicture read_picture_line(MtlLine& line, const std::string& of, std::size_t number) {
    MtlPicture picture{.file = "", .line = number};
    while (line.rest().starts_with('-')) {
        const std::string option(line.next());
        if (option == "-s" || option == "-o" || option == "-t") {
            DVec3 all(line.value(option));
            const double rest = option == "-s" ? 1 : 0;
            all.y = line.at_number() ? line.value(option) : rest, all.z = line.at_number() ? line.value(option) : rest;
            if (option == "-s") picture.place.scale = all;
            if (option == "-o") picture.place.offset = all;
            if (option == "-s" && (all.x == 0 || all.y == 0)) line.fail("a picture cannot be scaled by 0");
        } else if (option == "-bm") {
            picture.strength = line.value(option);
        } else if (option == "-mm") {
            line.value(option), line.value(option);
        } else if (option == "-clamp") {
            picture.place.clamped = line.next() == "on";
        } else {
            line.next();  // all other options, those of later programs too, have one argument
        }
    }
    picture.file = line.rest();
    if (picture.file.empty()) line.fail("'" + of + "' names no file");
    std::ranges::replace(picture.file, '\\', '/');
    return picture;
}

/// Reads the values of a line into the material; false if the word is not known.
bool read_value(MtlMaterial& own, const std::string& word, MtlLine& line, std::size_t number) {
    const auto color = [&](Color& value) {
        // Spectral curves and CIE XYZ are hardly ever written.
        if (!line.at_number()) return;
        value = line.values(word);
        for (int c = 0; c < 3; ++c) value[c] = std::max(value[c], 0.);
    };
    const auto picture = [&](std::optional<MtlPicture>& value) { value = read_picture_line(line, word, number); };
    if (word == "Kd")
        color(own.diffuse);
    else if (word == "Ks")
        color(own.specular);
    else if (word == "Ke")
        color(own.emission);
    else if (word == "Tf")
        color(own.filter.emplace(1));
    else if (word == "Ns")
        own.shininess = std::max(line.value(word), 0.);
    else if (word == "Ni")
        own.ior = line.value(word);
    else if (word == "d")
        line.rest().starts_with("-halo") ? void(line.next()) : void(),
            own.opacity = std::clamp(line.value(word), 0., 1.);
    else if (word == "Tr")
        own.opacity = 1 - std::clamp(line.value(word), 0., 1.);
    else if (word == "illum")
        own.illum = static_cast<int>(std::clamp(line.value(word), 0., 10.));
    else if (word == "map_Kd")
        picture(own.color_picture);
    else if (word == "map_d")
        picture(own.opacity_picture);
    else if (word == "map_bump" || word == "map_Bump" || word == "bump" || word == "Bump")
        picture(own.bump);
    else if (word == "norm" || word == "map_Kn" || word == "map_kn")
        picture(own.normal);
    else
        return word == "Ka" || word == "Km" || word == "sharpness";  // they have no part in what is shown
    return true;
}

}  // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& path, std::vector<std::string>& warnings) {
    std::vector<MtlMaterial> list;
    std::set<std::string> unknown;
    std::size_t number = 0;
    for (std::size_t start = 0; start < text.size(); ++number) {
        const std::size_t end = std::min(text.find_first_of("\r\n", start), text.size());
        std::string_view content = text.substr(start, end - start);
        start = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
        while (!content.empty() && (is_space(content.back()) || content.back() == '\0')) content.remove_suffix(1);
        MtlLine line(content, path, number + 1);
        const std::string word(line.next());
        if (word.empty() || word[0] == '#') continue;
        if (word == "newmtl") {
            list.emplace_back().name = line.rest();
            continue;
        }
        if (list.empty()) {
            // Some programs write values of no material first.
            MtlMaterial none;
            read_value(none, word, line, number + 1);
            continue;
        }
        if (!read_value(list.back(), word, line, number + 1) && unknown.insert(word).second && unknown.size() <= 20)
            warnings.push_back(path + ":" + std::to_string(number + 1) + ": left out: " + strahl::quoted(word));
    }
    return list;
}

Material material_of(const MtlMaterial& own, const std::string& path, const std::string& beside, Textures& textures) {
    namespace fs = std::filesystem;
    const auto name = [&](const MtlPicture& picture) {
        return (fs::path(beside).parent_path() / picture.file).string();
    };
    const auto pixels_of = [&](const std::optional<MtlPicture>& picture) {
        return !picture ? nullptr
                        : textures.read((fs::path(path).parent_path() / picture->file).string(),
                                        path + ":" + std::to_string(picture->line));
    };
    const auto opacity = [&](const FilePixels& pixels, bool grey) {
        Opacity result(pixels, grey);
        result.factor = own.opacity;
        return result;
    };
    Color diffuse = linear_light(own.diffuse);
    Material material = plain_material(diffuse);
    const double shine = std::clamp(std::max({own.specular.x, own.specular.y, own.specular.z}), 0., 1.);
    material.specular = own.illum < 2 || own.shininess < 1 ? 0 : shine;
    material.pow = std::clamp(own.shininess, 1., 1e5);
    if (own.illum == 0) material.ambient = 1, material.diffuse = 0;
    if (const auto pixels = pixels_of(own.color_picture)) {
        TexturePlace place = own.color_picture->place;
        place.around = diffuse;
        // Many files have no colour, or the default one, beside a picture.
        const bool none = own.diffuse == Color(0) || own.diffuse == Color(.8) || own.diffuse == Color(.64);
        const bool clear = !pixels->opacity.empty() && !own.opacity_picture;
        material.rgb =
            Pigment(picture_by_uv(pixels, name(*own.color_picture), place, none ? Color(1) : diffuse, clear));
        if (clear) material.rgb = partly_clear(material.rgb, opacity(*pixels, false), place);
    }
    if (const auto pixels = pixels_of(own.opacity_picture)) {
        Opacity other = opacity(*pixels, true);
        other.file = name(*own.opacity_picture);
        material.rgb = partly_clear(material.rgb, std::move(other), own.opacity_picture->place);
    }
    const bool mirrors = own.illum >= 3 && own.illum <= 8;
    if (mirrors)
        material.reflection = shine, material.mirror = shine > 0 ? own.specular / std::max(shine, 1e-9) : Color(1);
    const bool glass = own.illum == 4 || own.illum == 6 || own.illum == 7 || own.illum == 9;
    double clear = 1 - own.opacity;
    if (clear == 0 && glass && own.filter)
        clear = std::clamp(std::max({own.filter->x, own.filter->y, own.filter->z}), 0., 1.);
    if (clear > 0 && !material.rgb.clear()) {
        if (glass) {
            material.refraction = clear;
            material.ior = own.illum == 9 ? 1 : std::clamp(own.ior, 1., 10.);
            if (material.diffuse * (1 - clear) < .05 || own.filter)
                material.rgb = Pigment(own.filter.value_or(Color(1)));
            if (own.illum == 7 && material.ior > 1) reflect_as_glass(material);
            material.diffuse *= 1 - clear, material.ambient *= 1 - clear;
        } else if (material.rgb.pattern) {
            material.refraction = clear, material.diffuse *= own.opacity, material.ambient *= own.opacity;
        } else {
            material.rgb.transmit = clear;
        }
    }
    if (own.emission != Color(0)) {
        // Light of its own is ambient light, which has the colour of the body.
        const Color glow = linear_light(own.emission);
        if (own.diffuse == Color(0) && !material.rgb.pattern) {
            material.rgb = Pigment(glow), material.ambient = 1, material.diffuse = 0;
        } else {
            const Color base = material.rgb.pattern ? Color(1) : material.rgb.color;
            const double before = material.ambient;
            material.ambient = 1;
            for (int c = 0; c < 3; ++c) material.glow[c] = before + std::min(glow[c] / std::max(base[c], 1e-3), 1e3);
        }
    }
    if (const auto pixels = pixels_of(own.bump)) {
        // A picture's black and white are so far apart in units of its side; .01 is a rough plaster.
        material.bump.pattern =
            std::make_shared<const Pattern>(picture_by_uv(pixels, name(*own.bump), own.bump->place));
        material.bump.height = .01 * own.bump->strength;
    }
    if (const auto pixels = pixels_of(own.normal)) {
        material.normal.pattern =
            std::make_shared<const Pattern>(picture_by_uv(pixels, name(*own.normal), own.normal->place));
        material.normal.height = own.normal->strength;
    }
    return material;
}

}  // namespace strahl
