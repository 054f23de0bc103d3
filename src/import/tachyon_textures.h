// What Tachyon calls a texture: the material of a body.
#pragma once
#include <string>
#include <unordered_map>

#include "import/builder.h"
#include "import/word_reader.h"

namespace strahl {

/// Rounded to 12 digits, so that 1 - 0.7 is 0.3.
double tidy(double v);

class TachyonTextures {
  public:
    TachyonTextures(WordReader& words, Builder& scene) : words(words), scene(scene) {}

    void define();        // after TEXDEF
    void define_alias();  // after TEXALIAS
    void skip_image();    // after IMAGEDEF
    /// The texture of a body: its name, or the word TEXTURE and its text. It becomes the material.
    void use();
    /// The text of a texture.
    Material read();
    /// That of a triangle whose corners have colours of their own, which are given apart.
    Material read_without_color();
    static Material usual();

  private:
    void add(const std::string& name, const Material& texture);
    Material read_coefficients();
    void skip_pattern();
    Material find(std::string_view name);

    WordReader& words;
    Builder& scene;
    std::unordered_map<std::string, Material> named;
};

}  // namespace strahl
