// Keeps what `define` has named: materials, and bodies with all their parts.
#pragma once
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "text/blocks/materials.h"
#include "text/reading/messages.h"

namespace strahl {

class Definitions {
  public:
    /// A body. Its material and those of its parts are numbers among `written`.
    struct NamedBody {
        Primitive primitive;
        std::vector<MaterialText> written;
        std::size_t bodies = 0;  // it and all its parts
        bool good = true;        // no error was found in it
        int levels = 0;          // of bodies in it; `add` counts them
    };

    /// Add a name. It is an error if it is taken, or a word of the language.
    void add(std::string_view name, const MaterialText& material, Diagnostics& diagnostics);
    void add(std::string_view name, NamedBody body, Diagnostics& diagnostics);

    /// The material of this name. Reports an unknown name, and throws ParseAbort.
    const MaterialText& material(std::string_view name, Diagnostics& diagnostics) const;
    /// The body of this name; null if there is none.
    const NamedBody* body(std::string_view name) const;
    /// These words, and the names of all bodies.
    std::vector<std::string_view> with_bodies(std::span<const std::string_view> words) const;

    /// The body with `by` added to the number of its material and those of its parts.
    static Primitive renumbered(Primitive primitive, int by);

  private:
    bool can_add(std::string_view name, Diagnostics& diagnostics) const;

    std::map<std::string_view, MaterialText, std::less<>> materials;
    std::map<std::string_view, NamedBody, std::less<>> bodies;
};

}  // namespace strahl
