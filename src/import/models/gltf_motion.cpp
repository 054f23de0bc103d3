#include "import/models/gltf_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <set>
#include <string_view>

#include "num/vec_math.h"

namespace strahl {
namespace {

/// The degrees about x, then y, then z of a rotation.
DVec3 degrees_of(const glm::dquat& q) {
    const glm::dmat3 m = glm::mat3_cast(q);  // m[column][row]
    const double x = std::atan2(m[1][2], m[2][2]), y = std::atan2(-m[0][2], std::hypot(m[0][0], m[0][1]));
    const double s = std::sin(x), c = std::cos(x);
    const double z = std::atan2(s * m[2][0] - c * m[1][0], c * m[1][1] - s * m[2][1]);
    return DVec3(x, y, z) * (180 / std::numbers::pi);
}

double not_zero(double factor) { return std::abs(factor) < 1e-6 ? (factor < 0 ? -1e-6 : 1e-6) : factor; }

/// The rotation of a quaternion (x, y, z, w).
template <class Numbers>
glm::dquat unit(const Numbers& v) {
    const double size = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
    return size > 1e-9 ? glm::dquat(v[3] / size, v[0] / size, v[1] / size, v[2] / size) : glm::dquat(1, 0, 0, 0);
}

}  // namespace

glm::dmat4 GltfPlace::matrix() const {
    return glm::translate(glm::dmat4(1), translation) * glm::mat4_cast(rotation) * glm::scale(glm::dmat4(1), scale);
}

std::vector<Transformation> GltfPlace::steps() const {
    std::vector<Transformation> steps;
    if (scale != DVec3(1)) steps.push_back(Scale{scale});
    if (rotation != glm::dquat(1, 0, 0, 0)) steps.push_back(Rotate{degrees_of(rotation)});
    if (translation != DVec3(0)) steps.push_back(Translate{translation});
    return steps;
}

MotionKey GltfPlace::key(double time) const {
    return {.time = time, .translate = translation, .rotate = degrees_of(rotation), .scale = scale};
}

GltfPlace place_of(const GltfValue& node, bool& sheared) {
    GltfPlace place;
    const auto limited = [&](const DVec3& v, const char* name) {
        if (!(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= 1e9)) node[name].fail("is beyond 1e9");
        return v;
    };
    if (const GltfValue all = node["matrix"]) {
        if (all.size() != 16) all.fail("should have 16 numbers");
        glm::dmat3 m;
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) m[c][r] = all.at(std::size_t(4 * c + r)).number(0);
        for (int r = 0; r < 3; ++r) place.translation[r] = all.at(std::size_t(12 + r)).number(0);
        limited(place.translation, "matrix");
        for (int c = 0; c < 3; ++c) place.scale[c] = not_zero(length(DVec3(m[c])));
        limited(place.scale, "matrix");
        DVec3 x = m[0] / place.scale.x, y = m[1] / place.scale.y, z = m[2] / place.scale.z;
        if (dot_product(cross_product(x, y), z) < 0) place.scale.x = -place.scale.x, x = -x;
        constexpr double hardly = 1e-4;
        sheared |= std::abs(dot_product(x, y)) > hardly || std::abs(dot_product(y, z)) > hardly ||
                   std::abs(dot_product(z, x)) > hardly;
        // Axes that are perpendicular (J. Gram, E. Schmidt).
        const auto along = [](const DVec3& v, const DVec3& otherwise) {
            return length(v) > 1e-9 ? normalize(v) : otherwise;
        };
        x = along(x, {1, 0, 0});
        y = along(y - dot_product(y, x) * x, std::abs(x.y) < .9 ? along(DVec3(0, 1, 0) - x.y * x, {0, 1, 0})
                                                                : along(DVec3(1, 0, 0) - x.x * x, {1, 0, 0}));
        place.rotation = glm::normalize(glm::quat_cast(glm::dmat3(x, y, cross_product(x, y))));
        return place;
    }
    place.translation = limited(node["translation"].numbers<3>(DVec3(0)), "translation");
    place.scale = limited(node["scale"].numbers<3>(DVec3(1)), "scale");
    for (int c = 0; c < 3; ++c) place.scale[c] = not_zero(place.scale[c]);
    if (node["rotation"]) place.rotation = unit(node["rotation"].numbers<4>(glm::dvec4(0, 0, 0, 1)));
    return place;
}

GltfMotions::GltfMotions(GltfFile& file, std::vector<std::string>& warnings) {
    const GltfValue animations = file.root()["animations"];
    if (animations.size() == 0) return;
    if (animations.size() > 1)
        warnings.push_back(file.path + ": the first of " + std::to_string(animations.size()) + " animations is shown");
    const GltfValue own = animations.at(0), list = own["channels"], samplers = own["samplers"];
    const std::size_t nodes = file.root()["nodes"].size();
    std::size_t others = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const GltfValue target = list.at(i)["target"];
        const std::string path = target["path"].text();
        const std::int64_t node = target["node"].index(nodes);
        constexpr std::array<std::string_view, 4> paths{"translation", "rotation", "scale", "weights"};
        const auto known = std::ranges::find(paths, path);
        if (node < 0 || known == paths.end()) {
            ++others;
            continue;
        }
        const GltfValue number = list.at(i)["sampler"];
        if (!number) number.fail("is missing");
        const GltfValue sampler = samplers.at(std::size_t(number.index(samplers.size())));
        const std::string kind = sampler["interpolation"].text("LINEAR");
        NodeChannel channel{static_cast<Path>(known - paths.begin()),
                            kind == "STEP",
                            kind == "CUBICSPLINE",
                            file.numbers(sampler["input"], 1).values,
                            {}};
        const bool weighs = channel.path == Path::weights;
        channel.values = file.numbers(sampler["output"], weighs ? 1 : channel.path == Path::rotation ? 4 : 3);
        // Weights of all targets stand behind each other.
        if (const std::size_t rows = channel.times.size() * (channel.cubic ? 3 : 1);
            weighs && rows > 0 && channel.values.count % rows == 0 && channel.values.count > 0)
            channel.values.width = channel.values.count / rows, channel.values.count = rows;
        if (channel.times.empty() || channel.values.count != channel.times.size() * (channel.cubic ? 3 : 1))
            sampler.fail("should have as many values as times");
        for (std::size_t k = 0; k < channel.times.size(); ++k)
            if (!(channel.times[k] >= (k > 0 ? channel.times[k - 1] : -1e6)) || channel.times[k] > 1e6)
                sampler["input"].fail("times should ascend, and be at most 1e6");
        seconds = std::max(seconds, channel.times.back());
        channels[std::size_t(node)].push_back(std::move(channel));
    }
    if (others > 0)
        warnings.push_back(file.path + ": " + std::to_string(others) +
                           " channels of the animation are left out, of other things than nodes and morph targets");
}

std::vector<double> GltfMotions::NodeChannel::at(double time) const {
    const auto value = [&](std::size_t key, int part) {
        const std::size_t row = cubic ? 3 * key + std::size_t(part) : key;
        const auto first = values.values.begin() + std::ptrdiff_t(values.width * row);
        return std::vector<double>(first, first + std::ptrdiff_t(values.width));
    };
    const auto next = std::size_t(std::ranges::upper_bound(times, time) - times.begin());
    if (next == 0) return value(0, 1);
    if (next == times.size() || steps) return value(next - 1, 1);
    const double span = times[next] - times[next - 1], t = span > 0 ? (time - times[next - 1]) / span : 0;
    std::vector<double> a = value(next - 1, 1);
    const std::vector<double> b = value(next, 1);
    if (path == Path::rotation && !cubic) {
        const glm::dquat turned = glm::slerp(unit(a), unit(b), t);
        return {turned.x, turned.y, turned.z, turned.w};
    }
    const double t2 = t * t, t3 = t2 * t;
    const std::vector<double> out = value(next - 1, 2), in = value(next, 0);
    for (std::size_t k = 0; k < a.size(); ++k)
        a[k] = !cubic ? (1 - t) * a[k] + t * b[k]
                      : (2 * t3 - 3 * t2 + 1) * a[k] + (t3 - 2 * t2 + t) * span * out[k] + (3 * t2 - 2 * t3) * b[k] +
                            (t3 - t2) * span * in[k];
    return a;
}

GltfPlace GltfMotions::place(std::size_t node, const GltfPlace& rest, double time) const {
    GltfPlace place = rest;
    const auto own = channels.find(node);
    if (own == channels.end()) return place;
    for (const NodeChannel& channel : own->second) {
        const std::vector<double> value = channel.at(time);
        if (channel.path == Path::translation) place.translation = {value[0], value[1], value[2]};
        if (channel.path == Path::rotation) place.rotation = unit(value);
        if (channel.path == Path::scale) place.scale = {value[0], value[1], value[2]};
    }
    for (int c = 0; c < 3; ++c) {
        place.translation[c] = std::clamp(place.translation[c], -1e9, 1e9);
        place.scale[c] = std::clamp(not_zero(place.scale[c]), -1e9, 1e9);
    }
    return place;
}

std::optional<std::vector<double>> GltfMotions::weights(std::size_t node, double time) const {
    const auto own = channels.find(node);
    if (own == channels.end()) return {};
    const auto channel = std::ranges::find(own->second, Path::weights, &NodeChannel::path);
    return channel == own->second.end() ? std::nullopt : std::optional(channel->at(time));
}

std::vector<MotionKey> GltfMotions::keys(std::size_t node, const GltfPlace& rest) const {
    const auto own = channels.find(node);
    if (own == channels.end()) return {};
    std::set<double> times;
    bool between = false;  // the places between two keys are not on a line
    for (const NodeChannel& channel : own->second) {
        if (channel.path == Path::weights) continue;
        // Some files begin before 0, which is not seen.
        for (const double time : channel.times) times.insert(std::max(time, 0.));
        between |= channel.steps || channel.cubic;
        for (std::size_t k = 1; channel.steps && k < channel.times.size(); ++k)
            times.insert(std::max({channel.times[k] - 1e-4, channel.times[k - 1] + 1e-6, 0.}));
    }
    if (times.empty()) return {};
    // Motions are curves through their keys: more keys keep these near the lines of the file.
    constexpr std::size_t enough = 120, most = 2000;
    const double first = *times.begin(), last = *times.rbegin();
    if (times.size() < enough || times.size() > most) {
        if (times.size() > most) times.clear();
        for (std::size_t i = 0; i <= enough; ++i) times.insert(first + (last - first) * double(i) / double(enough));
    }
    std::vector<MotionKey> keys;
    for (const double time : times) {
        if (!keys.empty() && time - keys.back().time < 1e-7) continue;
        GltfPlace place = this->place(node, rest, time);
        for (int c = 0; c < 3; ++c) {
            // A motion cannot turn a body inside out.
            if (!keys.empty() && (place.scale[c] < 0) != (keys[0].scale[c] < 0))
                place.scale[c] = keys[0].scale[c] < 0 ? -1e-6 : 1e-6;
        }
        keys.push_back(place.key(time));
    }
    if (keys.size() < 2) keys.clear();
    return keys;
}

}  // namespace strahl
