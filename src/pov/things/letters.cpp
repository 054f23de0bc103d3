// Reads fonts by FreeType (freetype.org/freetype2/docs/reference).
#include "pov/things/letters.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <map>
#include <memory>

#include "files/error.h"
#include "files/utf8.h"
#include "files/words.h"

namespace strahl::pov {
namespace {

struct CloseFont {
    void operator()(FT_Library library) const { FT_Done_FreeType(library); }
    void operator()(FT_Face face) const { FT_Done_Face(face); }
};

using Point = Contour::Point;

/// Collects the contours of a letter. The points are in halves of the font's units: FreeType computes in whole numbers,
/// also the middles between two controls, where curves meet.
struct ContourTaker {
    static constexpr int shift = 1;
    double em;  // in halves
    std::vector<Contour> contours{};

    Point point(const FT_Vector& v) const { return {double(v.x) / em, double(v.y) / em}; }
    int add(const Contour::Stroke& step) { return contours.back().strokes.push_back(step), 0; }
};

int move_to(const FT_Vector* to, void* user) {
    auto& own = *static_cast<ContourTaker*>(user);
    own.contours.push_back({own.point(*to), {}});
    return 0;
}
int line_to(const FT_Vector* to, void* user) {
    auto& own = *static_cast<ContourTaker*>(user);
    return own.add({own.point(*to), own.point(*to)});
}
int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
    auto& own = *static_cast<ContourTaker*>(user);
    return own.add({own.point(*control), own.point(*to)});
}
int cubic_to(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* user) {
    auto& own = *static_cast<ContourTaker*>(user);
    return own.add({own.point(*first), own.point(*to), own.point(*second)});
}

/// Returns the characters of a text. Without UTF-8 POV-Ray shows blanks for all that are not ASCII.
std::u32string characters_of(const std::string& text, bool utf8) {
    std::u32string all;
    if (utf8 && find_invalid(text) != text.npos) return std::u32string(text.begin(), text.end());
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (!utf8)
            all.push_back(byte < 0x80 ? byte : U' ');
        else if (continues(c))
            all.back() = all.back() << 6 | (byte & 63u);
        else
            all.push_back(byte < 0x80 ? byte : byte < 0xE0 ? byte & 31u : byte < 0xF0 ? byte & 15u : byte & 7u);
    }
    return all;
}

}  // namespace

std::vector<Letter> letters_of(const std::string& font, const std::string& line, bool utf8) {
    const auto fault = [&] { return FileError(strahl::quoted(font) + " is not a font with outlines"); };
    FT_Library freetype = nullptr;
    if (FT_Init_FreeType(&freetype)) throw fault();
    const std::unique_ptr<FT_LibraryRec_, CloseFont> library(freetype);
    FT_Face opened = nullptr;
    if (FT_New_Face(freetype, font.c_str(), 0, &opened)) throw fault();
    const std::unique_ptr<FT_FaceRec_, CloseFont> face(opened);
    if (!FT_IS_SCALABLE(opened) || opened->units_per_EM == 0) throw fault();
    // Without UTF-8 POV-Ray finds letters by the map for the Macintosh, which may have others than that for Unicode.
    const bool old = !utf8 && FT_Select_Charmap(opened, FT_ENCODING_APPLE_ROMAN) == 0;
    // A font of symbols has only its own map.
    const bool symbols = !old && FT_Select_Charmap(opened, FT_ENCODING_UNICODE) != 0;
    if (symbols) FT_Select_Charmap(opened, FT_ENCODING_MS_SYMBOL);
    constexpr FT_Outline_Funcs takers{move_to, line_to, conic_to, cubic_to, ContourTaker::shift, 0};
    const double em = opened->units_per_EM;
    std::vector<Letter> letters;
    std::map<FT_UInt, std::shared_ptr<const ContourData>> known;
    double x = 0;
    FT_UInt before = 0;
    for (const char32_t c : characters_of(line, utf8)) {
        FT_UInt own = FT_Get_Char_Index(opened, c);
        if (own == 0 && symbols) own = FT_Get_Char_Index(opened, 0xF000 + c);
        if (FT_Load_Glyph(opened, own, FT_LOAD_NO_SCALE)) throw fault();
        FT_Outline& outline = opened->glyph->outline;
        if (letters.empty()) {
            x = -double(opened->glyph->metrics.horiBearingX) / em;
        } else if (FT_Vector kern{}; !FT_Get_Kerning(opened, before, own, FT_KERNING_UNSCALED, &kern)) {
            x += double(kern.x) / em;
        }
        std::shared_ptr<const ContourData>& contours = known[own];
        if (!contours) {
            ContourTaker taker{.em = 2 * em};
            if (FT_Outline_Decompose(&outline, &takers, &taker)) throw fault();
            contours = std::make_shared<const ContourData>(std::move(taker.contours));
        }
        letters.push_back({contours, x});
        x += double(opened->glyph->metrics.horiAdvance) / em;
        before = own;
    }
    return letters;
}

}  // namespace strahl::pov
