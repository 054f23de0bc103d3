// What `define` gives names to: materials, and bodies with all their parts.
#pragma once
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "text/blocks/materials.h"
#include "text/reading/messages.h"

namespace strahl {

class Definitions {
  public:
    /// A body whose materials, and those of its parts, are numbers among `written`.
    struct Body {
        Primitive primitive;
        std::vector<MaterialText> written;
        std::size_t bodies = 0;  // it and all its parts
        bool good = true;        // no error was reported in it
        int levels = 0;          // of bodies in it; `add` counts them
    };

    /// Names that are taken or words of the language are errors.
    void add(std::string_view name, const MaterialText& material, Diagnostics& diagnostics);
    void add(std::string_view name, Body body, Diagnostics& diagnostics);

    /// Reports an unknown name, and throws ParseAbort.
    const MaterialText& material(std::string_view name, Diagnostics& diagnostics) const;
    /// Null if no body has this name.
    const Body* body(std::string_view name) const;
    /// Words and the names of all bodies.
    std::vector<std::string_view> with_bodies(std::span<const std::string_view> words) const;

    /// With `by` added to the numbers of its material and of its parts'.
    static Primitive renumbered(Primitive primitive, int by);

  private:
    bool can_add(std::string_view name, Diagnostics& diagnostics) const;

    std::map<std::string_view, MaterialText, std::less<>> materials;
    std::map<std::string_view, Body, std::less<>> bodies;
};

}  // namespace strahl
