#include "povref/convert/motions.h"

#include <algorithm>

#include "num/decimal.h"
#include "povref/convert/layout.h"
#include "povref/convert/sentences.h"
#include "scene/moving_scene.h"

namespace strahl {
namespace {

/// Returns statements for the moment of a key.
std::string key_text(const MotionKey& key) {
    std::string text;
    for (const Transformation& step : steps_of(key)) text.append(" ").append(step_text(step));
    return text;
}

template <class V>
std::string cubic(const V& p, const V& q, const V& m, const V& n, const char* share) {
    return "Cubic(" + text_of(p) + ", " + text_of(q) + ", " + text_of(m) + ", " + text_of(n) + ", " + share + ")";
}
/// Declares the share of the curve that is behind.
std::string share_text(const Spline& spline) {
    const double k = spline.knots;
    return "    #declare Share = " + cubic(0., 1., spline.way.m / k, spline.way.n / k, "Over") + ";\n";
}

/// Returns statements for the moments between two keys.
std::string between_text(const Window<MotionKey>& w) {
    const MotionKey &from = *w.key[1], &to = *w.key[2];
    std::string text = "    #declare Over = (clock - " + text_of(from.time) + ")/" + text_of(w.seconds[1]) + ";\n";
    if (from.ease != 0 || to.ease != 0)
        text += "    #declare Over = " + cubic(0., 1., 1 - from.ease, 1 - to.ease, "Over") + ";\n";
    if (from.scale != to.scale) {
        DVec3 m, n;
        for (int c = 0; c < 3; ++c) {
            const auto [before, here, after] =
                w.differences([c](const MotionKey& a, const MotionKey& b) { return b.scale[c] - a.scale[c]; });
            const Monotone way = monotone(w, before, here, after);
            m[c] = way.m, n[c] = way.n;
        }
        text += "    scale " + cubic(from.scale, to.scale, m, n, "Over") + "\n";
    } else if (from.scale != DVec3(1)) {
        text += "    " + step_text(Scale{from.scale}) + "\n";
    }
    if (const auto [spline, start, about] = rotation_curve(w); spline.knots > 0)
        text += share_text(spline) + "    Turn(" + text_of(about[2]) + ", Share*Share*Share)\n    Turn(" +
                text_of(about[1]) + ", Share*Share*(3 - 2*Share))\n    Turn(" + text_of(about[0]) +
                ", 1 - (1 - Share)*(1 - Share)*(1 - Share))\n";
    if (from.rotate != DVec3(0)) text += "    rotate " + text_of(from.rotate) + "\n";
    if (const Spline s = spline_of(w, &MotionKey::translate); s.knots > 0)
        text += share_text(s) + "    translate " + cubic(from.translate, to.translate, s.m, s.n, "Share") + "\n";
    else if (from.translate != DVec3(0))
        text += "    translate " + text_of(from.translate) + "\n";
    return text;
}

std::string declaration(const Motion& motion, const std::string& name) {
    const std::vector<MotionKey>& keys = motion.keys;
    const int count = static_cast<int>(keys.size());
    std::string text = "#declare " + name + " = transform {\n  #if (clock <= " + text_of(keys.front().time) + ")" +
                       key_text(keys.front()) + " #end\n";
    for (int i = 0; i + 1 < count; ++i)
        text += "  #if (clock > " + text_of(keys[i].time) + " & clock < " + text_of(keys[i + 1].time) + ")\n" +
                between_text(window_between(keys.data(), count, 0, i)) + "  #end\n  #if (clock " +
                (i + 2 < count ? "= " : ">= ") + text_of(keys[i + 1].time) + ")" + key_text(keys[i + 1]) + " #end\n";
    return text + "}\n";
}

}  // namespace

std::string PovMotions::use(const Motion& motion) {
    auto known = std::ranges::find(
        declared, motion, [](const auto& pair) -> auto& { return pair.first; });
    if (known == declared.end()) {
        declared.emplace_back(motion, "Motion_" + std::to_string(declared.size() + 1));
        known = declared.end() - 1;
    }
    return "transform { " + known->second + " }";
}

std::string PovMotions::section() const {
    if (declared.empty()) return "";
    std::string text =
        heading("Motions") +
        comment(
            "`clock` is the time in seconds. Between keys, Over is the share of the time that has passed, and Share "
            "that of the curve. Rotations are products of turns about vectors by angles equal to their lengths.") +
        "#macro Cubic(P, Q, M, N, H)\n"
        "  (P*((1 - H)*(1 - H)*(1 + 2*H)) + Q*(H*H*(3 - 2*H)) + (M*(1 - H) - N*H)*((1 - H)*H))\n"
        "#end\n"
        "#macro Turn(About, Part)\n"
        "  #if (vlength(About) > 0)\n"
        "    #local A = vaxis_rotate(x, About, degrees(vlength(About)*Part));\n"
        "    #local B = vaxis_rotate(y, About, degrees(vlength(About)*Part));\n"
        "    #local C = vaxis_rotate(z, About, degrees(vlength(About)*Part));\n"
        "    matrix <A.x, A.y, A.z, B.x, B.y, B.z, C.x, C.y, C.z, 0, 0, 0>\n"
        "  #end\n"
        "#end\n";
    for (const auto& [motion, name] : declared) text += declaration(motion, name);
    return text;
}

std::vector<std::string> statements(const std::vector<Transformation>& steps, PovMotions& motions) {
    std::vector<std::string> items;
    for (const Transformation& step : steps) {
        const Motion* const motion = std::get_if<Motion>(&step);
        items.push_back(motion ? motions.use(*motion) : step_text(step));
    }
    return items;
}

}  // namespace strahl
