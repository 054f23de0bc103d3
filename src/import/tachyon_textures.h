// Reads textures of Tachyon, which are materials of bodies.
#pragma once
#include <string>
#include <unordered_map>

#include "import/builder.h"
#include "import/word_reader.h"

namespace strahl {

/// The number rounded to 12 decimals, so that 1 - 0.7 is 0.3.
double tidy(double v);

class TachyonTextures {
  public:
    TachyonTextures(WordReader& words, SceneBuilder& scene) : words(words), scene(scene) {}

    void define();        // reads what follows TEXDEF
    void define_alias();  // ... TEXALIAS
    void skip_image();    // ... IMAGEDEF
    /// Reads the texture of a body, its name or the word TEXTURE and its text, and makes it the material.
    void use();
    /// Reads the text of a texture.
    Material read();
    /// Reads the text of a texture without a colour: corners of triangles can have colours of their own.
    Material read_without_color();
    /// The default texture.
    static Material usual();

  private:
    void add(const std::string& name, const Material& texture);
    Material read_coefficients();
    void skip_pattern();
    Material find(std::string_view name);

    WordReader& words;
    SceneBuilder& scene;
    std::unordered_map<std::string, Material> named;
};

}  // namespace strahl
