// Arrays: their sizes, elements and copies.
#include <algorithm>

#include "pov/language/interpreter.h"

namespace strahl::pov {
namespace {

constexpr int most_array_levels = 16;  // of arrays in arrays

}  // namespace

std::size_t Interpreter::subscripts(const ArrayThing& array) {
    std::size_t index = 0;
    for (const int size : array.sizes) {
        expect('[');
        const double value = read_number();
        if (!(value > -tiny && value + tiny < size))
            fail(last, "this subscript is outside of the array: it must be 0 to " + std::to_string(size - 1));
        index = index * static_cast<std::size_t>(size) + static_cast<std::size_t>(value + tiny);
        expect(']');
    }
    return index;
}

std::shared_ptr<ArrayThing> Interpreter::new_array(std::vector<int> sizes, int levels) {
    std::size_t count = 1;
    for (const int size : sizes) {
        count *= static_cast<std::size_t>(size);
        if (count > options.limits.bytes / sizeof(NamedValue)) fail(last, "this array needs too much memory");
    }
    if (levels > most_array_levels) fail(last, "arrays are nested too deeply");
    *bytes += count * sizeof(NamedValue);
    check_limits();
    auto array = std::make_shared<ArrayThing>();
    array->sizes = std::move(sizes);
    array->elements.resize(count);
    array->levels = levels;
    array->account = bytes;
    return array;
}

NamedValue Interpreter::copy(const NamedValue& value) {
    if (value.kind != ValueKind::array) return value;
    const auto& from = static_cast<const ArrayThing&>(*value.thing);
    auto array = new_array(from.sizes, from.levels);
    for (std::size_t i = 0; i < from.elements.size(); ++i) array->elements[i] = copy(from.elements[i]);
    return {ValueKind::array, {}, std::move(array)};
}

void Interpreter::add_level(ArrayThing& array, const NamedValue& element) {
    array.levels = std::max(array.levels, static_cast<const ArrayThing&>(*element.thing).levels + 1);
    if (array.levels > most_array_levels) fail(last, "arrays are nested too deeply");
}

NamedValue Interpreter::read_array() {
    take();
    std::vector<int> sizes;
    while (with_directives(false, [&] { return accept('['); })) {
        const double size = read_number() + tiny;
        if (!(size >= 1 && size < 2e9)) fail(last, "invalid array: its size must be 1 or more");
        sizes.push_back(static_cast<int>(size));
        expect(']');
        if (sizes.size() == 5) break;
    }
    if (sizes.empty()) expected("the size of the array, in brackets,");
    auto array = new_array(std::move(sizes), 1);
    std::size_t element = 0;
    if (with_directives(false, [&] { return code(); }) == '{') read_elements(*array, 0, element);
    return {ValueKind::array, {}, std::move(array)};
}

void Interpreter::read_elements(ArrayThing& array, std::size_t dimension, std::size_t& element) {
    const Depth guard(*this);
    expect('{');
    for (int i = 0; i < array.sizes[dimension]; ++i) {
        if (dimension + 1 < array.sizes.size()) {
            read_elements(array, dimension + 1, element);
        } else {
            NamedValue value = right_side(true);
            if (value.kind == ValueKind::array) add_level(array, value);
            array.elements[element++] = std::move(value);
        }
        accept(',');
    }
    expect('}');
}

}  // namespace strahl::pov
