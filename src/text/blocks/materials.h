// Materials as text gives them, and a list of materials without duplicates.
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scene/leaves.h"

namespace strahl {

/// The parameters of a material that a block gives.
struct MaterialText {
    Material values;
    std::array<bool, std::tuple_size_v<decltype(Material::fields)>> named{};  // which are given, in field order
    bool coated = false;                                                      // coats, or none, are given

    /// Adds the parameters that `more` gives, which replace those given before.
    void add(const MaterialText& more) {
        values = more.on(values);
        for (std::size_t i = 0; i < named.size(); ++i) named[i] |= more.named[i];
        coated |= more.coated;
    }
    /// The base with these parameters in place of its own.
    Material on(const Material& base) const {
        Material result = base;
        if (coated) result.coats = values.coats;
        auto is_named = named.begin();
        const auto change = [&](const auto& field) {
            if (*is_named++) result.*field.member = values.*field.member;
        };
        std::apply([&](const auto&... field) { (change(field), ...); }, Material::fields);
        if (values.follows.empty() && base.follows.empty()) return result;
        is_named = named.begin();
        const auto forget = [&](const auto& field) {
            if (*is_named++) std::erase_if(result.follows, [&](const Follow& f) { return f.parameter == field.name; });
        };
        std::apply([&](const auto&... field) { (forget(field), ...); }, Material::fields);
        result.follows.insert(result.follows.end(), values.follows.begin(), values.follows.end());
        sort(result.follows);
        return result;
    }
};

/// The material from which a coat's parameters differ.
inline Material coat_base() {
    Material base;
    base.reflection = 0, base.specular = 0;
    return base;
}

/// Hashes the fields of a material.
class MaterialHash {
  public:
    std::size_t operator()(const Material& material) const {
        std::size_t hash = 0;
        add_fields(hash, material, Material::fields);
        for (const Material& coat : material.coats) add(hash, double((*this)(coat)));
        add(hash, material.interior);
        return hash;
    }

  private:
    static void add(std::size_t& hash, double v) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(v + 0.0)) * 0x9E3779B97F4A7C15u;  // -0 becomes 0, which equals it
        hash ^= hash >> 29;
    }
    static void add(std::size_t& hash, const DVec3& v) { add(hash, v.x), add(hash, v.y), add(hash, v.z); }
    static void add(std::size_t& hash, const Pigment& pigment) {
        add(hash, pigment.color);
        if (pigment.pattern) add(hash, *pigment.pattern);
    }
    static void add(std::size_t& hash, const Relief& relief) {
        if (relief.pattern) add(hash, relief.height), add(hash, *relief.pattern);
    }
    static void add(std::size_t& hash, const Pattern& pattern) {
        const auto& [kind, colors, transformations, by_uv] = pattern;
        std::visit([&]<class Kind>(const Kind& own) { add_fields(hash, own, Kind::fields); }, kind);
        if (const ImagePattern* const image = std::get_if<ImagePattern>(&kind))
            hash ^= std::hash<std::string>()(image->file);
        if (const SolidPattern* const solid = std::get_if<SolidPattern>(&kind))
            hash ^= std::hash<const void*>()(solid->function.get());
        for (const ColorStop& stop : colors) {
            add(hash, stop.at), add(hash, stop.color);
            if (stop.pattern) add(hash, *stop.pattern);
        }
        struct {
            std::size_t& hash;
            void operator()(const Rotate& step) const { add(hash, step.degrees); }
            void operator()(const Translate& step) const { add(hash, step.by); }
            void operator()(const Scale& step) const { add(hash, step.by); }
            void operator()(const Motion&) const {}  // a pattern moves only with its body
        } values{hash};
        for (const Transformation& step : transformations) std::visit(values, step);
    }
    template <class Struct, class Fields>
    static void add_fields(std::size_t& hash, const Struct& own, const Fields& fields) {
        std::apply([&](const auto&... field) { (add(hash, own.*field.member), ...); }, fields);
    }
};

/// Numbers materials in the order of first use: that of a composite first, then those of its parts.
class Materials {
  public:
    int number(const Material& material) {
        if (!list.empty() && list[last] == material) return last;
        const std::size_t hash = MaterialHash()(material);
        for (auto [entry, end] = numbers.equal_range(hash); entry != end; ++entry)
            if (list[static_cast<std::size_t>(entry->second)] == material) return last = entry->second;
        last = static_cast<int>(list.size());
        numbers.emplace(hash, last);
        list.push_back(material);
        return last;
    }
    /// Gives a body that was read, and its parts, their materials; before, these are numbers among `written`. A part
    /// starts from the material of its composite, wherever that stands in the text.
    void settle(Primitive& primitive, const Material& base, const std::vector<MaterialText>& written) {
        const Material own = written[primitive.material].on(base);
        primitive.material = number(own);
        change_parts(primitive, [&](Primitive& part) { settle(part, own, written); });
    }
    std::vector<Material> list;

  private:
    std::unordered_multimap<std::size_t, int> numbers;  // by the hashes of materials
    int last = 0;
};

}  // namespace strahl
