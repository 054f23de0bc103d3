// Random scenes with everything that the language has.
#pragma once
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "scene/kinds/kinds.h"
#include "scene/scene.h"
#include "tests/referee/random_pattern.h"
#include "text/parse.h"

namespace strahl {

/// Plain, odd and extreme values.
class RandomScenes {
  public:
    explicit RandomScenes(unsigned seed) : random(seed) {}

    Scene scene() {
        result = {};
        result.camera = camera();
        if (chance(3))
            result.settings = {color(), std::uniform_int_distribution(1, 256)(random),
                               chance(2)   ? 0
                               : chance(2) ? 1
                                           : uniform(1, 5),
                               chance(2) ? uniform(0, 1) : 0};
        if (chance(2)) result.background = chance(3) ? Pigment(pattern()) : Pigment(color());
        if (chance(4)) result.fog = Fog{length(), color()};
        while (chance(6) && result.background_coats.size() < 7) result.background_coats.push_back(clear(color()));
        if (result.fog && chance(2)) {
            const Color more = color();
            result.fog->altitude = length(), result.fog->offset = more.x, result.fog->up = DVec3(uniform(0, 1), 0, 1);
            result.fog->filter = uniform(0, 1), result.fog->transmit = uniform(0, 1);
            result.fog->turbulence = more, result.fog->octaves = 3, result.fog->omega = uniform(0, 1);
        }
        for (int i = below(6); i > 0; --i) result.lights.push_back(light());
        palette.resize(1 + below(4));
        for (Material& material : palette) material = chance(4) ? Material{} : random_material();
        for (int i = below(12); i > 0; --i) result.primitives.push_back(primitive(3));
        if (chance(3)) result.flythrough = flythrough(result.camera);
        return result;
    }

  private:
    int below(int n) { return std::uniform_int_distribution(0, n - 1)(random); }
    bool chance(int one_in) { return below(one_in) == 0; }
    double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
    /// Sometimes short, sometimes with all digits.
    double number(double reach) { return chance(2) ? std::round(uniform(-reach, reach)) / 4 : uniform(-reach, reach); }

    DVec3 position() {
        DVec3 p;
        for (int i = 0; i < 3; ++i) {
            constexpr double odd[] = {0, -0.0, 1e9, -1e9, 5e-324, 1e-300, .1, 1. / 3, 123456789.123456789};
            p[i] = chance(6) ? odd[below(std::size(odd))] : number(100);
        }
        return p;
    }
    double length() { return chance(6) ? std::exp(uniform(-300, 20)) : .25 + std::fabs(number(10)); }
    double positive() { return chance(6) ? std::exp(uniform(-20, 20)) : .25 + std::fabs(number(10)); }
    double not_negative() { return chance(6) ? 0 : chance(8) ? 1e9 : std::fabs(number(4)); }
    Light light() {
        Light own{position(), color()};
        if (chance(3)) {
            own.spot = Spot{position(), uniform(0, 45), uniform(45, 90), not_negative()};
            if (own.spot->look_at == own.position) own.spot.reset();
        } else if (chance(3)) {
            own.area = Area{{length(), 0, 0}, {0, -length(), 0}, below(2) * below(9), 3};
            own.soft = chance(2);
            if (own.area->columns == 0) own.area->rows = 0;
            if (own.area->columns > 0 && chance(2)) own.area->v.x = .5 * own.area->v.y;
            if (own.soft && own.area->columns > 0 && chance(2)) own.adaptive = below(4);
            own.jitter = own.soft && own.area->columns > 4;
            if (own.soft && own.area->columns > 1) own.circular = chance(2), own.orient = chance(2);
        } else if (chance(3)) {
            own.direction = position(), own.position = DVec3(0);
            if (*own.direction == DVec3(0)) own.direction = DVec3(0, 0, -1);
            if (chance(2)) own.from = position();
            if (own.from && chance(2)) own.beam = length(), own.core = length(), own.tightness = not_negative();
        }
        if (chance(4)) own.motion = motion();
        own.shadowless = chance(6);
        if (chance(6)) own.group = not_negative();
        if (chance(6)) own.color = DVec3(0) - own.color;
        if (chance(6)) own.fade_distance = not_negative(), own.fade_power = not_negative();
        return own;
    }
    Color color() { return {not_negative(), not_negative(), not_negative()}; }

    Material random_material(bool coats = true) {
        Material material;
        const auto fill = [&](const auto& field) {
            auto& value = material.*field.member;
            if (chance(2)) return;
            if constexpr (std::is_same_v<decltype(value), Pigment&>)
                value = chance(3) ? Pigment(pattern()) : clear(color());
            else if constexpr (std::is_same_v<decltype(value), DVec3&>)
                value = field.range == Range::zero_to_one ? min(color(), Color(1)) : color();
            else if constexpr (std::is_same_v<decltype(value), Bump&>)
                value = chance(2) ? Bump{} : bump();
            else if constexpr (std::is_same_v<decltype(value), NormalMap&>)
                value = chance(2) ? NormalMap{} : normal_map();
            else
                value = field.range == Range::zero_to_one ? uniform(0, 1)
                        : field.range == Range::positive  ? positive()
                                                          : not_negative();
        };
        std::apply([&](const auto&... field) { (fill(field), ...); }, Material::fields);
        if (coats)
            while (chance(4) && material.coats.size() < 7) material.coats.push_back(random_material(false));
        return material;
    }
    /// A pigment that may let light through.
    Pigment clear(const Color& color) {
        Pigment own(color);
        if (chance(3)) own.filter = uniform(0, 1), own.transmit = uniform(0, 1);
        return own;
    }
    Pattern pattern(bool inner = false) {
        Dice dice(random());
        Pattern own = random_pattern(dice);
        if (!own.colors.empty() && chance(6)) own.kind = random_solid(dice);
        if (chance(2)) own.transformations = transformations();
        if (!inner && own.colors.size() == 2 && chance(8)) {
            Pattern more = pattern(true);
            own.by_uv = more.by_uv = false;
            own.colors[1] = {own.colors[1].at, Color(0), 0, 0, std::make_shared<const Pattern>(std::move(more))};
        }
        for (ColorStop& stop : own.colors)
            if (!stop.pattern && chance(2)) {
                stop.color = color();
                if (chance(4)) stop.filter = uniform(0, 1), stop.transmit = uniform(0, 1);
            }
        return own;
    }
    Bump bump() {
        Dice dice(random());
        Bump own = random_bump(dice);
        if (chance(2)) own.height = not_negative();
        return own;
    }
    NormalMap normal_map() {
        Dice dice(random());
        NormalMap own = random_normal_map(dice);
        if (chance(2)) own.height = not_negative();
        return own;
    }
    int material_number() {
        const Material& material = palette[below(static_cast<int>(palette.size()))];
        const auto known = std::find(result.materials.begin(), result.materials.end(), material);
        const auto number = static_cast<int>(known - result.materials.begin());
        if (known == result.materials.end()) result.materials.push_back(material);
        return number;
    }
    /// Composites of it have parts of their own down to so many levels, and the usual ones below.
    Primitive primitive(int levels) {
        const int number = material_number();
        Shape own = shape();
        const auto add_parts = [&]<class Kind>(Kind& kind) {
            if constexpr (is_composite<Kind>) {
                std::vector<Primitive> parts;
                for (int i = below(3); i >= 0; --i) parts.push_back(part(levels - 1));
                kind.parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
            }
        };
        if (levels > 0) std::visit(add_parts, own);
        std::vector<Transformation> steps = transformations();
        for (int i = below(9); i > 6; --i) steps.insert(steps.begin() + below(int(steps.size()) + 1), motion());
        return {own, number, steps};
    }
    Motion motion() {
        Motion own;
        const DVec3 sign(chance(4) ? -1 : 1);
        for (int i = 2 + below(3); i > 0; --i) {
            const double time = (own.keys.empty() ? 0 : own.keys.back().time) + uniform(1e-9, 5);
            own.keys.push_back({time, {number(9), 0, number(9)}, {0, number(400), 0}, sign * uniform(.5, 2)});
            own.keys.back().ease = ease_at(time);
        }
        return own;
    }
    Primitive part(int levels) {
        while (true) {
            const std::vector<Material> before = result.materials;
            Primitive own = primitive(levels);
            if (fits_composite(own.shape)) return own;
            result.materials = before;
        }
    }
    template <class Kind>
    Kind any_of_kind() {
        Kind kind;
        const auto fill = [&](const auto& field) {
            auto& value = kind.*field.member;
            if constexpr (std::is_same_v<decltype(value), DVec3&>)
                value = position();
            else
                value = field.range == Range::steps ? std::floor(uniform(1, 1000)) : length();
        };
        do std::apply([&](const auto&... field) { (fill(field), ...); }, Kind::fields);
        while (kind.fault());
        return kind;
    }
    template <class... Kinds>
    Shape shape_of(std::type_identity<std::variant<Kinds...>>) {
        Shape result;
        int left = below(sizeof...(Kinds));
        ((left-- == 0 ? void(result = any_of_kind<Kinds>()) : void()), ...);
        return result;
    }
    Shape shape() { return shape_of(std::type_identity<Shape>{}); }

    std::vector<Transformation> transformations() {
        std::vector<Transformation> steps;
        for (int i = chance(2) ? 0 : below(5); i > 0; --i) switch (below(4)) {
                case 0:
                    steps.push_back(Rotate{{number(400), number(400), number(400)}});
                    break;
                case 1:
                    steps.push_back(Translate{{number(9), number(9), number(9)}});
                    break;
                case 2:
                    steps.push_back(Scale{DVec3(uniform(.5, 2))});
                    break;
                default:
                    steps.push_back(Scale{{uniform(.5, 2), -uniform(.5, 2), uniform(.5, 2)}});
            }
        return steps;
    }
    Camera camera() {
        Camera result{position(), position(), position(), uniform(1e-9, 90), {}};
        if (chance(2)) result.aspectratio = positive();
        // Every third camera has another projection, chosen by digits of its angle.
        const int digits = static_cast<int>(1000 * result.fov) % (3 * static_cast<int>(projection_words.size()));
        if (digits % 3 == 0) result.projection = static_cast<Projection>(digits / 3);
        if (angular(result.projection)) result.fov *= 4;
        if (result.projection <= Projection::orthographic && chance(3)) {
            result.aperture = positive();
            if (chance(3)) result.blades = 3 + below(60);
            if (chance(3))
                result.focus = positive();
            else if (chance(2))
                result.focus_on = result.look_at;
        }
        if (chance(3)) result.shutter = positive(), result.shutter_in_frames = chance(2);
        if (result.projection != Projection::orthographic && chance(4)) {
            result.stereo = chance(2) ? Stereo::side_by_side : Stereo::top_bottom;
            result.eye_distance = positive();
            if (result.projection == Projection::perspective && chance(2)) result.convergence = positive();
        }
        return degenerate(result) ? camera() : result;
    }
    Flythrough flythrough(const Camera& scene_camera) {
        Flythrough path;
        path.loop = chance(2);
        double time = 0;
        for (int i = 2 + below(4); i > 0;) {
            Keyframe key{time, position(), position(), {}, {}};
            if (chance(2)) key.fov = uniform(1e-9, 90);
            if (chance(2)) key.up = position();
            if (degenerate(camera_of(key, scene_camera))) continue;
            key.ease = ease_at(time);
            path.keys.push_back(key);
            time += uniform(1e-9, 5);
            --i;
        }
        path.duration = time;
        return path;
    }

    /// Returns the ease of a key, by digits of its time: every third one has some.
    static double ease_at(double time) {
        const double share = 1e6 * time - std::floor(1e6 * time);
        return share < 2. / 3 ? 0 : std::round(share * 8) == 8 ? 1 : 3 * share - 2;
    }

    std::mt19937 random;
    Scene result;
    std::vector<Material> palette;
};

/// Is a text a scene? Those of random scenes are not where a body is none by chance.
inline bool is_valid(const std::string& text) try {
    parse_scene(text, "test", {}, made_up_pixels);
    return true;
} catch (const FileError&) {
    return false;
}

}  // namespace strahl
