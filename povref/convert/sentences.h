// Writes bodies and transformations in POV-Ray's words.
#pragma once
#include <algorithm>
#include <cmath>
#include <string>

#include "num/decimal.h"
#include "num/vec_math.h"
#include "scene/kinds/kinds.h"
#include "scene/motion/transformation.h"

namespace strahl {

/// Returns the statement of a transformation.
inline std::string step_text(const Transformation& step) {
    // POV-Ray treats smaller factors as 0, and 0 as 1.
    constexpr double least = 1e-9;
    struct {
        std::string operator()(const Rotate& r) const { return "rotate " + text_of(r.degrees); }
        std::string operator()(const Translate& t) const { return "translate " + text_of(t.by); }
        std::string operator()(const Scale& s) const {
            const DVec3& f = s.by;
            if (std::min({std::fabs(f.x), std::fabs(f.y), std::fabs(f.z)}) < least)
                return "matrix <" + text_of(f.x) + ", 0, 0, 0, " + text_of(f.y) + ", 0, 0, 0, " + text_of(f.z) +
                       ", 0, 0, 0>";
            return "scale " + (f.x == f.y && f.y == f.z ? text_of(f.x) : text_of(f));
        }
        std::string operator()(const Motion&) const { return ""; }  // for those of bodies see motions.h
    } words;
    return std::visit(words, step);
}

/// Returns a mesh without its closing brace. A closed one gets a direction in which POV-Ray counts whether a point is
/// inside. POV-Ray keeps the points in single precision, so one that is far from the origin is moved there and back.
inline std::string sentence(const Mesh& mesh) {
    const Box box = mesh.bounds();
    const DVec3 size = box.size();
    const bool far = dot_product(box.centre(), box.centre()) > dot_product(size, size);
    const DVec3 middle = far ? box.centre() : DVec3(0);
    const auto &points = mesh.data->points, &normals = mesh.data->normals;
    const auto &triangles = mesh.data->triangles, &corner_normals = mesh.data->corner_normals;
    const MeshData::Corners* const places = mesh.data->place_numbers();
    std::string text = "mesh {";
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        text += corner_normals.empty() ? "\n  triangle {" : "\n  smooth_triangle {";
        for (int k = 0; k < 3; ++k) {
            text += (k > 0 ? ", " : " ") + text_of(points[triangles[i][k]] - middle);
            if (!corner_normals.empty()) text += ", " + text_of(normals[corner_normals[i][k]]);
        }
        for (int k = 0; places && k < 3; ++k) {
            const auto& [u, v] = mesh.data->places[places[i][k]];
            text += (k > 0 ? ", <" : " uv_vectors <") + text_of(u) + ", " + text_of(v) + ">";
        }
        text += " }";
    }
    text += open_side(*mesh.data) ? "\n " : "\n  inside_vector <0, 0, 1>";
    return far ? text + " translate " + text_of(middle) : text;
}

/// Returns the kind of spline, and the points, of contours: straight lines, or if `curved` all lines as the cubic
/// curves of Bezier's that they are. Those of prisms are `closed`. `point` writes a point.
template <class PointText>
std::string spline_of(const ContourData& data, bool curved, bool closed, const std::string& between,
                      const PointText& point) {
    using Point = Contour::Point;
    const auto mix = [](const Point& p, const Point& q, double share) {
        return Point{p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])};
    };
    std::vector<Point> points;
    for (const Contour& own : data.contours) {
        Point from = own.start;
        const auto add = [&](const Contour::Stroke& step) {
            points.push_back(from);
            const auto& [control, end, second] = step;
            if (curved && second)
                points.insert(points.end(), {control, *second, end});
            else if (curved && step.straight())
                points.insert(points.end(), {mix(from, end, 1. / 3), mix(from, end, 2. / 3), end});
            else if (curved)
                points.insert(points.end(), {mix(from, control, 2. / 3), mix(end, control, 2. / 3), end});
            from = end;
        };
        for (const Contour::Stroke& step : own.strokes) add(step);
        if (closed && from != own.start) add({own.start, own.start});
        if (!curved) points.push_back(closed ? own.start : from);
    }
    std::string text = (curved ? "bezier_spline " : "linear_spline ") + between + std::to_string(points.size());
    for (const Point& p : points) text += ", " + point(p);
    return text;
}
inline bool any_curve(const ContourData& data) {
    bool curved = false;
    for (const Contour& own : data.contours)
        for (const Contour::Stroke& step : own.strokes) curved |= !step.straight();
    return curved;
}
/// Returns a prism without its closing brace. POV-Ray's lies over its plane of x and z, so that it is turned.
inline std::string sentence(const Prism& prism) {
    const std::string heights =
        text_of(std::min(prism.base, prism.top)) + ", " + text_of(std::max(prism.base, prism.top)) + ", ";
    const auto point = [](const auto& p) { return text_of(Contour::Point{p[0], 0 - p[1]}); };
    return "prism { " + spline_of(*prism.data, any_curve(*prism.data), true, heights, point) + " rotate 90*x";
}
/// The same of a lathe. Only curves of Bezier's need not follow each other.
inline std::string sentence(const Lathe& lathe) {
    const auto point = [](const auto& p) { return text_of(p); };
    const bool curved = any_curve(*lathe.data) || lathe.data->contours.size() > 1;
    return "lathe { " + spline_of(*lathe.data, curved, false, "", point) + " sturm";
}

/// Returns a blob without its closing brace.
inline std::string sentence(const Blob& blob) {
    std::string text = "blob { threshold " + text_of(blob.threshold);
    for (const Lump& own : blob.data->lumps) {
        text += (own.from == own.to ? "\n  sphere { " : "\n  cylinder { ") + text_of(own.from) + ", ";
        if (own.from != own.to) text += text_of(own.to) + ", ";
        text += text_of(own.radius) + ", " + text_of(own.strength);
        std::string rows;
        for (const DVec3& row : {own.x, own.y, own.z})
            for (int i = 0; i < 3; ++i) rows += text_of(row[i]) + ", ";
        text += (own.x == Lump{}.x && own.y == Lump{}.y && own.z == Lump{}.z ? "" : " matrix <" + rows + "0, 0, 0>") +
                std::string(" }");
    }
    return text + "\n  sturm";
}

/// The same of a sweep.
inline std::string sentence(const SphereSweep& sweep) {
    const std::vector<SweptBall>& balls = sweep.data->balls;
    std::string text = "sphere_sweep { ";
    text += balls[0].through ? "cubic_spline, " : "b_spline, ";
    text += std::to_string(balls.size());
    for (const SweptBall& own : balls) text += ",\n  " + text_of(own.centre) + ", " + text_of(own.radius);
    return text + " tolerance 1e-6";
}

/// The same of a Julia set.
inline std::string sentence(const JuliaFractal& own) {
    const auto four = [](const DVec3& v, double w) {
        return "<" + text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z) + ", " + text_of(w) + ">";
    };
    std::string text = "julia_fractal { " + four(own.constant, own.fourth) + " " + own.words();
    if (own.step == JuliaStep::power) text += "(" + text_of(own.exponent) + ", " + text_of(own.imaginary) + ")";
    text += " max_iteration " + text_of(own.iterations) + " precision " + text_of(own.precision);
    return text + " slice " + four(own.slice, own.slice_fourth) + ", " + text_of(own.distance);
}

/// Returns a simple body without its closing brace, in the shape's own space.
inline std::string sentence(const Shape& shape) {
    const auto join = [](const char* keyword, const auto& first, const auto&... more) {
        return ((keyword + (" { " + text_of(first))) + ... + (", " + text_of(more)));
    };
    const auto words = [&](const auto& kind) {
        std::string text = std::apply(join, kind.pov());
        if constexpr (requires { kind.pov_more; }) text += kind.pov_more;
        if constexpr (requires { kind.pov_axes(); }) {
            std::string rows;
            for (const DVec3& row : kind.pov_axes())
                for (int i = 0; i < 3; ++i) rows += (rows.empty() ? "" : ", ") + text_of(row[i]);
            text += " matrix <" + rows + ">";
        }
        return text;
    };
    return std::visit(
        [&]<class Kind>(const Kind& kind) {
            if constexpr (std::is_same_v<Kind, Mesh> || lists_crossings<Kind>)
                return sentence(kind);
            else if constexpr (is_composite<Kind>)
                return std::string();
            else
                return words(kind);
        },
        shape);
}

}  // namespace strahl
