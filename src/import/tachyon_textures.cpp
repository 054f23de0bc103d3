#include "import/tachyon_textures.h"

#include <cmath>

#include "text/reading/messages.h"

namespace strahl {

double tidy(double v) { return std::round(v * 1e12) / 1e12; }

Material TachyonTextures::usual() {
    Material m;
    m.rgb = Color(1);
    m.ambient = .1, m.diffuse = .9, m.specular = 0, m.reflection = 0;
    return m;
}

void TachyonTextures::define() {
    const std::string name(words.take("the texture's name"));
    add(name, read());
}

void TachyonTextures::define_alias() {
    const std::string name(words.take("the texture's new name"));
    add(name, find(words.take("the texture's name")));
}

void TachyonTextures::add(const std::string& name, const Material& texture) {
    const auto [known, is_new] = named.try_emplace(name, texture);
    if (!is_new && known->second != texture)
        scene.warn("a second texture of this name: the first one holds, as in Tachyon");
}

void TachyonTextures::use() {
    const std::string_view word = words.take("a texture");
    scene.set_material(same_word(word, "TEXTURE") ? read() : find(word));
}

Material TachyonTextures::find(std::string_view name) {
    const auto known = named.find(std::string(name));
    if (known != named.end()) return known->second;
    scene.warn("there is no texture " + quoted(name) + "; the body is white, as in Tachyon");
    return usual();
}

Material TachyonTextures::read() {
    Material m = read_coefficients();
    m.rgb = words.vector_after("COLOR");
    words.expect("TEXFUNC");
    skip_pattern();
    return m;
}

Material TachyonTextures::read_without_color() {
    Material m = read_coefficients();
    words.expect("VCST");
    return m;
}

Material TachyonTextures::read_coefficients() {
    Material m = usual();
    m.ambient = words.number_after("AMBIENT");
    m.diffuse = words.number_after("DIFFUSE");
    m.reflection = words.number_after("SPECULAR");
    m.refraction = tidy(1 - words.number_after("OPACITY"));
    if (words.accept("TRANSMODE") && same_word(words.take("TRANSMODE"), "R3D"))
        scene.warn("TRANSMODE R3D: opacity is the same at every angle here");
    if (words.accept("OUTLINE")) {
        words.number("OUTLINE");
        words.number_after("OUTLINE_WIDTH");
        scene.warn("OUTLINE: bodies have no outlines here");
    }
    if (words.accept("PHONG")) {
        if (same_word(words.take("PLASTIC or METAL"), "METAL"))
            scene.warn("PHONG METAL: highlights have the colour of the light here, not that of the body");
        m.specular = words.number("PHONG");
        // Tachyon's highlight is J. Blinn's, (n.h)^p. Near its middle (h.l)^(p/4) is the same.
        m.pow = words.number_after("PHONG_SIZE") / 4;
    }
    return m;
}

void TachyonTextures::skip_pattern() {
    static constexpr const char* names[] = {
        "plain",    "a checker", "grit",     "marble",  "wood", "a gradient", "a cylindrical checker",
        "an image", "an image",  "an image", "an image"};
    const long number = words.whole("TEXFUNC", 0, 10);
    if (number == 0) return;
    std::string what = names[number];
    if (number >= 7) what.append(" ").append(quoted(words.take("the image's file")));
    for (const char* const word : {"CENTER", "ROTATE", "SCALE"}) words.vector_after(word);
    static constexpr const char* axes[] = {"UAXIS", "VAXIS", "WAXIS"};
    for (int i = 0; i < number - 7 && number > 8; ++i) words.vector_after(axes[i]);
    scene.warn("the pattern TEXFUNC " + std::to_string(number) + ", " + what +
               ", is left out; the body has the texture's COLOR");
}

void TachyonTextures::skip_image() {
    words.take("the image's name");
    words.expect("FORMAT"), words.expect("RGB24"), words.expect("RESOLUTION");
    long pixels = 1;
    for (int i = 0; i < 3; ++i) pixels *= words.whole("RESOLUTION", 0, 1'000'000);
    words.expect("ENCODING"), words.expect("HEX");
    for (long i = 0; i < pixels; ++i) words.take("a pixel");
    scene.warn("IMAGEDEF: images are left out");
}

}  // namespace strahl
