// Reads fonts by FreeType (freetype.org/freetype2/docs/reference).
#include "pov/things/letters.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <memory>

#include "files/utf8.h"
#include "files/words.h"
#include "scene/error.h"

namespace strahl::pov {
namespace {

constexpr int pieces = 6;  // of a curve

struct CloseFont {
    void operator()(FT_Library library) const { FT_Done_FreeType(library); }
    void operator()(FT_Face face) const { FT_Done_Face(face); }
};

/// Collects the outlines of a letter. The points are in units of the font.
struct OutlineTaker {
    double em, x;
    std::vector<Outline> outlines{};
    Point2 last{};

    Point2 point(const FT_Vector& v) const { return {x + double(v.x) / em, double(v.y) / em}; }
    void add(const Point2& p) {
        if (p != last) outlines.back().push_back(p);
        last = p;
    }
    /// Adds a curve of Bezier's, whose first control point is the last point.
    void add_curve(const Point2& b, const Point2& c, const Point2& d) {
        const Point2 a = last;
        for (int i = 1; i <= pieces; ++i) {
            const double t = double(i) / pieces, s = 1 - t;
            const double w[4]{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
            add(i == pieces ? d
                            : Point2{w[0] * a[0] + w[1] * b[0] + w[2] * c[0] + w[3] * d[0],
                                     w[0] * a[1] + w[1] * b[1] + w[2] * c[1] + w[3] * d[1]});
        }
    }
};

int move_to(const FT_Vector* to, void* user) {
    auto& own = *static_cast<OutlineTaker*>(user);
    own.last = own.point(*to);
    own.outlines.push_back({own.last});
    return 0;
}
int line_to(const FT_Vector* to, void* user) {
    auto& own = *static_cast<OutlineTaker*>(user);
    return own.add(own.point(*to)), 0;
}
int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
    auto& own = *static_cast<OutlineTaker*>(user);
    const Point2 a = own.last, b = own.point(*control), c = own.point(*to);
    const auto between = [&b](const Point2& end) {
        return Point2{(end[0] + 2 * b[0]) / 3, (end[1] + 2 * b[1]) / 3};
    };
    return own.add_curve(between(a), between(c), c), 0;
}
int cubic_to(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* user) {
    auto& own = *static_cast<OutlineTaker*>(user);
    return own.add_curve(own.point(*first), own.point(*second), own.point(*to)), 0;
}

/// Returns the characters of a text.
std::u32string characters_of(const std::string& text) {
    std::u32string all;
    if (find_invalid(text) != text.npos) return std::u32string(text.begin(), text.end());
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (continues(c))
            all.back() = all.back() << 6 | (byte & 63u);
        else
            all.push_back(byte < 0x80 ? byte : byte < 0xE0 ? byte & 31u : byte < 0xF0 ? byte & 15u : byte & 7u);
    }
    return all;
}

}  // namespace

std::vector<std::vector<Outline>> letters_of(const std::string& font, const std::string& line) {
    const auto fault = [&] { return FileError(strahl::quoted(font) + " is not a font with outlines"); };
    FT_Library freetype = nullptr;
    if (FT_Init_FreeType(&freetype)) throw fault();
    const std::unique_ptr<FT_LibraryRec_, CloseFont> library(freetype);
    FT_Face opened = nullptr;
    if (FT_New_Face(freetype, font.c_str(), 0, &opened)) throw fault();
    const std::unique_ptr<FT_FaceRec_, CloseFont> face(opened);
    if (!FT_IS_SCALABLE(opened) || opened->units_per_EM == 0) throw fault();
    const bool symbols = FT_Select_Charmap(opened, FT_ENCODING_UNICODE) != 0;  // a font of symbols has only its own map
    if (symbols) FT_Select_Charmap(opened, FT_ENCODING_MS_SYMBOL);
    constexpr FT_Outline_Funcs takers{move_to, line_to, conic_to, cubic_to, 0, 0};
    const double em = opened->units_per_EM;
    std::vector<std::vector<Outline>> letters;
    double x = 0;
    FT_UInt before = 0;
    for (const char32_t c : characters_of(line)) {
        FT_UInt own = FT_Get_Char_Index(opened, c);
        if (own == 0 && symbols) own = FT_Get_Char_Index(opened, 0xF000 + c);
        if (FT_Load_Glyph(opened, own, FT_LOAD_NO_SCALE)) throw fault();
        FT_Outline& outline = opened->glyph->outline;
        if (letters.empty()) {
            x = -double(opened->glyph->metrics.horiBearingX) / em;
        } else if (FT_Vector kern{}; !FT_Get_Kerning(opened, before, own, FT_KERNING_UNSCALED, &kern)) {
            x += double(kern.x) / em;
        }
        OutlineTaker taker{.em = em, .x = x};
        if (FT_Outline_Decompose(&outline, &takers, &taker)) throw fault();
        for (Outline& each : taker.outlines)
            if (each.size() > 1 && each.back() == each.front()) each.pop_back();
        std::erase_if(taker.outlines, [](const Outline& each) { return each.size() < 3; });
        letters.push_back(std::move(taker.outlines));
        x += double(opened->glyph->metrics.horiAdvance) / em;
        before = own;
    }
    return letters;
}

}  // namespace strahl::pov
