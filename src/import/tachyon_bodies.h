// Reads the bodies of Tachyon's scenes.
#pragma once
#include <string_view>
#include <vector>

#include "import/builder.h"
#include "import/tachyon_textures.h"
#include "import/word_reader.h"

namespace strahl {

class TachyonBodies {
  public:
    TachyonBodies(WordReader& words, SceneBuilder& scene) : words(words), scene(scene), textures(words, scene) {}

    /// Reads what follows this word, if it declares a body or a texture.
    bool read(std::string_view word);

    /// Reads a point or a direction. Tachyon's world is left-handed; it is mirrored in z.
    DVec3 vector(const char* what) {
        const DVec3 v = words.vector(what);
        return {v.x, v.y, -v.z};
    }
    /// Reads one after this word, which must come next.
    DVec3 vector_after(const char* word) { return words.expect(word), vector(word); }

  private:
    void read_sphere();
    void read_plane();
    void read_box();
    void read_ring();
    void read_tube();
    void read_endless_cylinder();
    void read_chain();
    void read_triangle(bool smooth, bool colored);
    void read_vertex_array();
    void read_strip(bool strip);
    void add_facet(long a, long b, long c);
    void skip_landscape();
    void skip_volume();
    void skip_triangle_file();

    WordReader& words;
    SceneBuilder& scene;
    TachyonTextures textures;
    std::vector<DVec3> points, normals, colors;  // of the vertex array being read
    Material array_material;
};

}  // namespace strahl
