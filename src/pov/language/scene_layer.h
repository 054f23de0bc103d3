// The functions that the language calls in the layer above it, which knows bodies, textures, cameras and lights.
#pragma once
#include <memory>
#include <utility>

#include "pov/language/user_function.h"
#include "pov/language/value.h"

namespace strahl::pov {

class Interpreter;

/// Called by the interpreter while it reads. The functions that read tokens leave the first that is not theirs.
struct SceneLayer {
    virtual ~SceneLayer() = default;

    /// Reads the right side of a declaration that begins with a word such as `sphere`, `texture` or `color_map`, or
    /// with the identifier of a thing of this layer. Returns kind `none` without reading anything if it is no such
    /// word.
    virtual NamedValue read_thing(Interpreter& in) = 0;
    /// Reads the block of `#default { ... }` from '{' to '}'.
    virtual void read_default(Interpreter& in) = 0;
    /// Reads the inside of `function { pigment { ... } }`, `function { pattern { ... } }` and
    /// `function { transform { ... } }`, which begins with that word, up to before the last '}'.
    virtual std::shared_ptr<const FunctionThing> read_function(Interpreter& in) = 0;

    /// Returns the nearest hit from `from` on towards `direction` with its outward normal; false if there is none.
    virtual bool trace(Interpreter& in, const Thing& object, const DVec3& from, const DVec3& direction, DVec3& hit,
                       DVec3& normal) = 0;
    virtual bool inside(Interpreter& in, const Thing& object, const DVec3& point) = 0;
    /// Returns the corners of the object's bounding box.
    virtual std::pair<DVec3, DVec3> extent(Interpreter& in, const Thing& object) = 0;
};

}  // namespace strahl::pov
