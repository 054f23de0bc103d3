// Values of POV-Ray's scene language: what an identifier can stand for.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace strahl::pov {

/// The kinds of values. Those from `pigment` on are things of the layer above, which the language only hands on.
enum class ValueKind : std::uint8_t {
    none,
    number,
    uv,
    vector,
    vector4,
    color,
    string,
    array,
    spline,
    function,
    vector_function,
    macro,
    file,
    pigment,
    normal,
    finish,
    texture,
    material,
    interior,
    media,
    density,
    color_map,
    pigment_map,
    normal_map,
    texture_map,
    density_map,
    slope_map,
    camera,
    transform,
    fog,
    rainbow,
    sky_sphere,
    object
};
/// Names a kind in messages: "a number", "an array", "an object".
const char* name_of(ValueKind kind);

/// The value of an expression: 1 to 5 components.
struct Components {
    std::array<double, 5> value{};
    int count = 1;
};

/// A colour with the two ways in which POV-Ray lets light through, in single precision as there.
struct FilterColor {
    float red = 0, green = 0, blue = 0, filter = 0, transmit = 0;
    bool operator==(const FilterColor&) const = default;
};

/// Base of everything that an identifier can hold by reference: arrays, functions, and the things of the layer above.
struct Thing {
    virtual ~Thing() = default;
};

/// A string.
struct StringThing : Thing {
    explicit StringThing(std::string text) : text(std::move(text)) {}
    std::string text;
};

/// The value of an identifier or of an element of an array.
struct NamedValue {
    ValueKind kind = ValueKind::none;
    std::array<double, 5> number{};      // the components, of the kinds from number to color
    std::shared_ptr<const Thing> thing;  // the value, of all other kinds
};

/// An array. Its elements may be arrays themselves.
struct ArrayThing : Thing {
    std::vector<int> sizes;                // of each dimension
    std::vector<NamedValue> elements;      // the last index runs fastest; those without a value have kind `none`
    int levels = 1;                        // of arrays in arrays
    std::shared_ptr<std::size_t> account;  // counts the bytes of all arrays

    ~ArrayThing() override {
        if (account) *account -= elements.size() * sizeof(NamedValue);
    }
};

/// Differences below this are none for POV-Ray's comparisons.
inline constexpr double tiny = 1e-10;
inline bool is_true(double value) { return value < -tiny || value > tiny; }

}  // namespace strahl::pov
