// Reads the arguments of simple bodies.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "mesh/split.h"
#include "num/vec_math.h"
#include "pov/reading/reader.h"
#include "pov/reading/values.h"
#include "pov/things/surfaces.h"

namespace strahl::pov {
namespace {

using MeshPointer = std::shared_ptr<MeshData>;

/// Does the number of a texture come next, and not the next triangle?
bool at_texture_number(Interpreter& in) {
    const ValueKind kind = in.kind();
    return in.at_expression() && !in.at('<') && (kind == ValueKind::none || kind == ValueKind::number);
}

/// Reads over the arguments and modifiers of a body that cannot be shown, but not those that all bodies share.
void skip_arguments(Interpreter& in) {
    int depth = 0;
    while (depth > 0 || !in.at('}')) {
        if (in.at_end()) in.expect('}');
        depth += in.at('{') ? 1 : in.at('}') ? -1 : 0;
        in.take();
    }
}

/// Returns how the arguments of a simple body are written; "" for other bodies.
const char* form_of(std::uint16_t code) {
    switch (code) {
        case word("sphere"):
            return "sphere { <centre>, radius }";
        case word("box"):
            return "box { <corner>, <opposite corner> }";
        case word("cylinder"):
            return "cylinder { <one end>, <other end>, radius }";
        case word("cone"):
            return "cone { <one end>, its radius, <other end>, its radius }";
        case word("torus"):
            return "torus { major radius, minor radius }";
        case word("plane"):
            return "plane { <normal>, distance }";
        case word("disc"):
            return "disc { <centre>, <normal>, radius }";
        case word("triangle"):
            return "triangle { <corner>, <corner>, <corner> }";
        default:
            return "";
    }
}

/// The plane normal . p = |normal| * distance, behind its normal.
Plane plane_of(const DVec3& normal, double distance) {
    const DVec3 n = normalize(normal), size = abs(n);
    const DVec3 other = size.x <= size.y && size.x <= size.z ? DVec3(1, 0, 0)
                        : size.y <= size.z                   ? DVec3(0, 1, 0)
                                                             : DVec3(0, 0, 1);
    const DVec3 u = normalize(cross_product(other, n)), v = cross_product(n, u), a = distance * n;
    return {a, a + u, a + v};
}

/// Returns a box, or the rectangle that POV-Ray shows in place of a box that is flat in one direction.
Shape box_between(const DVec3& corner, const DVec3& other) {
    const DVec3 size = other - corner;
    const int flat = size.x == 0 ? 0 : size.y == 0 ? 1 : 2;
    DVec3 u(0), v(0);
    u[(flat + 1) % 3] = size[(flat + 1) % 3], v[(flat + 2) % 3] = size[(flat + 2) % 3];
    if (size[flat] != 0 || u == DVec3(0) || v == DVec3(0)) return Cuboid{corner, other};
    MeshData mesh;
    mesh.points = {corner, corner + u, other, corner + v}, mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return Mesh{std::make_shared<const MeshData>(std::move(mesh)), ""};
}

/// An edge of a polygon, from its lower end to its upper one.
struct Edge {
    Point2 low, high;
    double at(double height) const {
        const double share = (height - low[1]) / (high[1] - low[1]);
        return share == 1 ? high[0] : low[0] + share * (high[0] - low[0]);
    }
};

/// Returns the heights at which edges begin, end or cross each other, in order; and whether any cross.
std::pair<std::vector<double>, bool> heights_of(const std::vector<Edge>& edges) {
    std::vector<double> heights;
    bool any = false;
    for (const Edge& own : edges) {
        heights.insert(heights.end(), {own.low[1], own.high[1]});
        for (const Edge* other = &own + 1; other < edges.data() + edges.size(); ++other) {
            const double low = std::max(own.low[1], other->low[1]), high = std::min(own.high[1], other->high[1]);
            if (!(low < high)) continue;
            const double before = other->at(low) - own.at(low), behind = other->at(high) - own.at(high);
            if (before * behind < 0) any = true, heights.push_back(low + (high - low) * before / (before - behind));
        }
    }
    std::ranges::sort(heights);
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    return {heights, any};
}

/// Returns the normal of the plane in which points lie, as exactly as POV-Ray asks for, or 0.
DVec3 normal_of_plane(const std::vector<DVec3>& points) {
    constexpr double tolerance = 1e-10;
    DVec3 along(0), normal(0);
    for (const DVec3& point : points) {
        const DVec3 away = point - points[0];
        if (!(dot_product(along, along) > tolerance))
            along = away;
        else if (dot_product(away, away) > tolerance && !(dot_product(normal, normal) > tolerance))
            normal = cross_product(along, away);
    }
    if (!(dot_product(normal, normal) > tolerance)) return DVec3(0);
    const bool flat = std::ranges::all_of(points, [&](const DVec3& point) {
        return std::abs(dot_product(point - points[0], normal)) <= tolerance * length(normal);
    });
    return flat ? normal : DVec3(0);
}

/// Reads a polygon of one or several outlines. A point is in it if it is inside of an odd number of them. One whose
/// points are not in one plane is nothing, as in POV-Ray.
void read_polygon(Interpreter& in, ObjectThing& object) {
    const int count = in.read_integer();
    std::vector<DVec3> points;
    std::vector<std::vector<DVec3>> outlines(1);
    for (int i = 0; i < count; ++i) {
        std::vector<DVec3>& own = outlines.back();
        const DVec3 point = next_vector(in);
        points.push_back(point);
        const DVec3 away = abs(point - (own.empty() ? point : own[0]));
        if (own.empty() || std::max({away.x, away.y, away.z}) >= 1e-10)
            own.push_back(point);
        else if (i + 1 < count)
            outlines.emplace_back();
    }
    const DVec3 facing = normal_of_plane(points);
    if (facing == DVec3(0))
        return object.warn("a polygon whose corners are not in one plane, or are on a line, is not seen");
    std::erase_if(outlines, [](const auto& own) { return own.size() < 3; });
    if (outlines.empty()) return object.warn("a polygon of fewer than three corners is not seen");
    // Looks at it along the axis from which it is the largest.
    const std::vector<DVec3>& first = outlines[0];
    DVec3 normal(0);
    for (std::size_t i = 2; i < first.size(); ++i) {
        const DVec3 own = cross_product(first[i - 1] - first[0], first[i] - first[0]);
        if (length(own) > length(normal)) normal = own;
    }
    const DVec3 size = abs(normal);
    if (size == DVec3(0)) return object.warn("a polygon without area is not seen");
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int across = (axis + 1) % 3, up = (axis + 2) % 3;
    std::vector<Edge> edges;
    for (const std::vector<DVec3>& own : outlines)
        for (std::size_t i = 0; i < own.size(); ++i) {
            const DVec3 &p = own[i], &q = own[(i + 1) % own.size()];
            const Point2 from{p[across], p[up]}, to{q[across], q[up]};
            if (from[1] != to[1]) edges.push_back(from[1] < to[1] ? Edge{from, to} : Edge{to, from});
        }
    const auto [heights, crossed] = heights_of(edges);
    MeshData mesh;
    if (outlines.size() == 1 && !crossed) {
        mesh.points = first;
        std::vector<std::int32_t> corners(first.size());
        std::iota(corners.begin(), corners.end(), 0);
        FaceSplitter splitter;
        for (const FaceSplitter::Triangle& own : splitter.split(first, corners)) mesh.triangles.push_back(own);
    }
    // Between two heights edges lie side by side, and the first two, the next two and so on enclose a face.
    const std::size_t bands = mesh.triangles.empty() ? heights.size() : 0;
    for (std::size_t i = 1; i < bands; ++i) {
        const double low = heights[i - 1], high = heights[i];
        std::vector<const Edge*> beside;
        for (const Edge& own : edges)
            if (own.low[1] <= low && own.high[1] >= high) beside.push_back(&own);
        std::ranges::sort(beside, {}, [&](const Edge* own) { return own->at(low) + own->at(high); });
        for (std::size_t k = 0; k + 1 < beside.size(); k += 2) {
            const auto add = [&](double x, double height) {
                DVec3 p(0);
                p[across] = x, p[up] = height;
                p[axis] =
                    first[0][axis] +
                    (normal[across] * (first[0][across] - x) + normal[up] * (first[0][up] - height)) / normal[axis];
                mesh.points.push_back(p);
            };
            const auto corner = static_cast<std::int32_t>(mesh.points.size());
            add(beside[k]->at(low), low), add(beside[k + 1]->at(low), low);
            add(beside[k + 1]->at(high), high), add(beside[k]->at(high), high);
            const auto add_triangle = [&](int a, int b, int c) {
                if (mesh.points[std::size_t(corner + a)] == mesh.points[std::size_t(corner + b)]) return;
                if (mesh.points[std::size_t(corner + b)] == mesh.points[std::size_t(corner + c)]) return;
                mesh.triangles.push_back({corner + a, corner + b, corner + c});
            };
            add_triangle(0, 1, 2), add_triangle(2, 3, 0);
        }
    }
    if (mesh.triangles.empty()) return object.left_out("a polygon without area");
    const auto [a, b, c] = mesh.triangles[0];
    const auto point = [&](std::int32_t i) { return mesh.points[std::size_t(i)]; };
    object.turned_surface = dot_product(cross_product(point(b) - point(a), point(c) - point(a)), facing) > 0;
    object.kind = ObjectKind::shape;
    object.shape = Mesh{std::make_shared<const MeshData>(std::move(mesh)), ""};
}

/// The triangles of a mesh that share a texture.
struct MeshPart {
    MeshData data;
    bool smooth = false, mapped = false;
};

/// Makes meshes of parts, each with its texture; a part without one has that of the whole mesh. Of `solid` ones
/// triangles may run in any direction.
void set_meshes(ObjectThing& object, std::vector<MeshPart>& parts,
                const std::vector<std::shared_ptr<const TextureThing>>& textures, bool solid) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
        auto& [data, smooth, mapped] = parts[i];
        if (data.triangles.empty()) continue;
        join_points(data);
        if (solid && open_side(data)) turn_alike(data);
        if (!smooth) data.normals.clear(), data.corner_normals.clear();
        if (!mapped) data.places.clear(), data.corner_places.clear();
        auto part = std::make_shared<ObjectThing>();
        part->kind = ObjectKind::shape, part->word = object.word, part->place = object.place;
        part->shape = Mesh{std::make_shared<const MeshData>(std::move(data)), ""};
        if (i > 0) part->texture = PlacedTexture{textures[i - 1], {}};
        object.parts.push_back(std::move(part));
    }
    object.kind = object.parts.empty() ? ObjectKind::nothing : ObjectKind::unite;
    if (object.parts.size() != 1) return;
    const ObjectThing only = *object.parts[0];
    object.parts.clear();
    object.kind = only.kind, object.shape = only.shape, object.texture = only.texture;
}

/// Adds a triangle with corners of its own.
void add_triangle(MeshPart& part, const DVec3 (&points)[3], const DVec3 (&normals)[3],
                  const std::array<double, 2> (&places)[3]) {
    MeshData::Corners corners;
    for (int k = 0; k < 3; ++k) {
        corners[k] = static_cast<std::int32_t>(part.data.points.size());
        part.data.points.push_back(points[k]);
        part.data.normals.push_back(normals[k]);
        part.data.places.push_back(places[k]);
    }
    part.data.triangles.push_back(corners);
    part.data.corner_normals.push_back(corners);
}

/// The numbers of the textures of a triangle's corners, from 1 on; 0 for that of the mesh.
using TextureNumbers = std::array<std::size_t, 3>;

constexpr const char* uv_blends = "textures by uv that blend across a triangle: that of its first corner";

/// Returns a texture that blends from corner to corner, or null if one of them is by uv.
std::shared_ptr<const TextureThing> blended(std::vector<std::shared_ptr<const TextureThing>> corners) {
    auto all = std::make_shared<TextureThing>(*corners[0]);
    for (const auto& corner : corners)
        for (const LayerValues& layer : corner->layers)
            for (const Blend* const own : {&layer.pigment.blend, &layer.normal.blend, &layer.blend})
                if (own->uv) return nullptr;
    all->corners = std::move(corners);
    return all;
}

/// Returns the number of the first texture that is like each one, from 1 on, behind the 0 of none. Only textures of one
/// colour are compared.
std::vector<std::size_t> alike(const std::vector<std::shared_ptr<const TextureThing>>& textures) {
    std::map<std::array<float, 5>, std::vector<std::size_t>> known;
    std::vector<std::size_t> numbers{0};
    for (std::size_t i = 0; i < textures.size(); ++i) {
        numbers.push_back(i + 1);
        const LayerValues& own = textures[i]->layers[0];
        const FilterColor& c = own.pigment.color;
        if (textures[i]->layers.size() > 1 || own.blend || own.pigment.blend || own.normal.blend) continue;
        auto& same = known[{c.red, c.green, c.blue, c.filter, c.transmit}];
        const auto first = std::ranges::find_if(same, [&](std::size_t number) {
            return static_cast<const FinishValues&>(textures[number - 1]->layers[0].finish) == own.finish;
        });
        if (first != same.end())
            numbers.back() = *first;
        else
            same.push_back(i + 1);
    }
    return numbers;
}

DVec3 flat_normal(const DVec3 (&p)[3]) { return cross_product(p[1] - p[0], p[2] - p[0]); }

/// Reads the normal at a corner of a mesh. As in POV-Ray one without a length is that of x.
DVec3 read_corner_normal(Interpreter& in) {
    DVec3 normal = in.read_vector();
    if (std::max({std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)}) < 1e-10) normal.x = 1;
    return normal;
}

/// Sets the normals of a flat triangle. As in POV-Ray one is flat as well whose corners have one normal.
void set_normals(const DVec3 (&points)[3], DVec3 (&normals)[3], bool smooth) {
    const auto differs = [&](const DVec3& other) {
        const DVec3 way = normalize(normals[0]) - normalize(other);
        return dot_product(way, way) > 1e-10;
    };
    if (!smooth || (!differs(normals[1]) && !differs(normals[2]))) std::fill(normals, normals + 3, flat_normal(points));
}

bool is_flat(const DVec3 (&p)[3]) { return !Triangle{p[0], p[1], p[2]}.fault(); }

}  // namespace

std::shared_ptr<const TextureThing> PovReader::next_texture(Interpreter& in) {
    if (auto known = in.accept_thing<TextureThing>(ValueKind::texture)) return known;
    in.expect("texture");
    return read_texture(in);
}

/// Reads mesh { triangle { ... } ... } after '{'.
void PovReader::read_mesh(Interpreter& in, ObjectThing& object) {
    std::vector<MeshPart> parts(1);
    std::vector<std::shared_ptr<const TextureThing>> textures;
    std::map<const TextureThing*, std::size_t> numbers;  // of textures, from 1 on
    std::map<TextureNumbers, std::size_t> blends;        // the textures that blend across triangles, 0 if they cannot
    const auto add_texture = [&](std::shared_ptr<const TextureThing> texture) {
        in.count_bytes(sizeof(MeshPart) + sizeof(TextureThing) + sizeof(LayerValues), in.last_place());
        textures.push_back(std::move(texture)), parts.emplace_back();
        return textures.size();
    };
    const auto number_of = [&](const std::shared_ptr<const TextureThing>& texture) {
        const auto [known, is_new] = numbers.try_emplace(texture.get());
        if (is_new) known->second = add_texture(texture);
        return known->second;
    };
    while (in.at("triangle") || in.at("smooth_triangle")) {
        const bool smooth = in.at("smooth_triangle");
        in.take();
        in.count_bytes(bytes_of_triangle, in.last_place());
        in.begin_block();
        DVec3 points[3], normals[3];
        std::array<double, 2> places[3]{};
        for (int k = 0; k < 3; ++k) {
            points[k] = next_vector(in);
            if (smooth) in.skip_comma(), normals[k] = read_corner_normal(in);
        }
        std::vector<std::shared_ptr<const TextureThing>> corners(3);
        std::size_t number = 0;
        bool mapped = false;
        while (!in.at('}')) {
            if (in.accept("uv_vectors")) {
                for (auto& place : places) place = in.read_uv(), in.skip_comma();
                mapped = true;
            } else if (in.accept("texture_list")) {
                in.begin_block();
                for (auto& corner : corners) corner = next_texture(in), in.skip_comma();
                in.end_block();
            } else if (in.at("texture") || in.kind() == ValueKind::texture) {
                number = number_of(next_texture(in));
            } else {
                in.expected("'uv_vectors', 'texture', 'texture_list' or '}'");
            }
        }
        in.end_block();
        if (!is_flat(points)) continue;
        if (corners[0]) {
            const auto [known, is_new] =
                blends.try_emplace({number_of(corners[0]), number_of(corners[1]), number_of(corners[2])});
            if (is_new)
                if (const auto texture = blended(corners)) known->second = add_texture(texture);
            number = known->second ? known->second : known->first[0];
            if (known->second)
                places[0] = {0, 0}, places[1] = {1, 0}, places[2] = {0, 1}, mapped = true;
            else
                object.approximated(uv_blends);
        }
        set_normals(points, normals, smooth);
        parts[number].smooth |= smooth, parts[number].mapped |= mapped;
        add_triangle(parts[number], points, normals, places);
    }
    bool solid = false;
    for (; in.accept("inside_vector"); solid = true) object.inside_vector = in.read_vector();
    set_meshes(object, parts, textures, solid);
}

/// Reads mesh2 { ... } after '{'.
void PovReader::read_mesh2(Interpreter& in, ObjectThing& object) {
    MeshData all;
    std::vector<MeshData::Place> places;
    std::vector<MeshData::Corners> normal_indices, place_indices, faces;
    std::vector<TextureNumbers> face_textures;
    std::vector<std::shared_ptr<const TextureThing>> textures;
    bool solid = false;
    const auto read_corners = [&](std::vector<MeshData::Corners>& list) {
        in.begin_block();
        const int count = in.read_integer();
        for (int i = 0; i < count; ++i) {
            in.skip_comma();
            const DVec3 v = in.read_vector();
            list.push_back(
                {static_cast<std::int32_t>(v.x), static_cast<std::int32_t>(v.y), static_cast<std::int32_t>(v.z)});
            in.skip_comma();
            if (&list != &faces) continue;
            TextureNumbers& own = face_textures.emplace_back();
            for (std::size_t k = 0; k < 3 && at_texture_number(in); ++k) {
                const auto number = static_cast<std::size_t>(std::max(in.read_integer(), 0));
                for (std::size_t later = k; later < 3; ++later) own[later] = number + 1;
                in.skip_comma();
            }
        }
        in.end_block();
    };
    const auto read_list = [&](auto& list, const auto& read) {
        in.begin_block();
        const int count = in.read_integer();
        for (int i = 0; i < count; ++i) in.skip_comma(), list.push_back(read());
        in.skip_comma();
        in.end_block();
    };
    for (;;) {
        if (in.accept("vertex_vectors")) {
            // POV-Ray keeps them in single precision, which turns small triangles.
            read_list(all.points, [&] { return DVec3(Vec3<float>(in.read_vector())); });
        } else if (in.accept("normal_vectors")) {
            read_list(all.normals, [&] { return read_corner_normal(in); });
        } else if (in.accept("uv_vectors")) {
            read_list(places, [&] { return in.read_uv(); });
        } else if (in.accept("texture_list")) {
            read_list(textures, [&] { return next_texture(in); });
        } else if (in.accept("face_indices")) {
            read_corners(faces);
        } else if (in.accept("normal_indices")) {
            read_corners(normal_indices);
        } else if (in.accept("uv_indices")) {
            read_corners(place_indices);
        } else if (in.accept("inside_vector")) {
            object.inside_vector = in.read_vector(), solid = true;
        } else {
            break;
        }
    }
    const auto& normal_of = normal_indices.empty() && all.normals.size() == all.points.size() ? faces : normal_indices;
    const auto& place_of = place_indices.empty() && places.size() == all.points.size() ? faces : place_indices;
    std::vector<MeshPart> parts(textures.size() + 1);
    const std::vector<std::size_t> first_alike = alike(textures);
    std::map<TextureNumbers, std::size_t> blends;  // the parts of triangles across which textures blend
    for (std::size_t i = 0; i < faces.size(); ++i) {
        DVec3 points[3], normals[3];
        std::array<double, 2> own[3]{};
        const bool smooth = i < normal_of.size();
        bool mapped = i < place_of.size();
        for (int k = 0; k < 3; ++k) {
            const auto item = [&](const auto& list, std::int32_t n) {
                if (n < 0 || static_cast<std::size_t>(n) >= list.size())
                    in.fail("mesh2: a number of its lists is too large");
                return list[static_cast<std::size_t>(n)];
            };
            points[k] = item(all.points, faces[i][k]);
            if (smooth) normals[k] = item(all.normals, normal_of[i][k]);
            if (mapped) own[k] = item(places, place_of[i][k]);
        }
        if (!is_flat(points)) continue;
        TextureNumbers numbers = face_textures[i];
        for (std::size_t& number : numbers) {
            if (number >= first_alike.size()) in.fail("mesh2: a number of a texture is too large");
            number = first_alike[number];
        }
        std::size_t which = numbers[0];
        if (numbers[1] != which || numbers[2] != which) {
            const auto [known, is_new] = blends.try_emplace(numbers, parts.size());
            if (is_new) {
                textures.push_back(
                    blended({textures[numbers[0] - 1], textures[numbers[1] - 1], textures[numbers[2] - 1]}));
                parts.emplace_back();
            }
            if (textures[known->second - 1])
                which = known->second, own[0] = {0, 0}, own[1] = {1, 0}, own[2] = {0, 1}, mapped = true;
            else
                object.approximated(uv_blends);
        }
        MeshPart& part = parts[which];
        set_normals(points, normals, smooth);
        part.smooth |= smooth, part.mapped |= mapped;
        add_triangle(part, points, normals, own);
    }
    set_meshes(object, parts, textures, solid);
}

bool PovReader::is_shape(std::uint16_t code) {
    static constexpr std::array words{word("sphere"),
                                      word("box"),
                                      word("cylinder"),
                                      word("cone"),
                                      word("torus"),
                                      word("plane"),
                                      word("disc"),
                                      word("triangle"),
                                      word("smooth_triangle"),
                                      word("polygon"),
                                      word("mesh"),
                                      word("mesh2"),
                                      word("quadric"),
                                      word("superellipsoid"),
                                      word("lathe"),
                                      word("prism"),
                                      word("sor"),
                                      word("blob"),
                                      word("sphere_sweep"),
                                      word("height_field"),
                                      word("text"),
                                      word("bicubic_patch"),
                                      word("isosurface"),
                                      word("parametric"),
                                      word("julia_fractal"),
                                      word("ovus"),
                                      word("cubic"),
                                      word("quartic"),
                                      word("poly"),
                                      word("polynomial")};
    return std::ranges::find(words, code) != words.end();
}

/// Takes the caps off a cylinder or a cone: it becomes longer, and is clipped where it ended.
void PovReader::open_ends(ObjectThing& object) {
    if (object.kind != ObjectKind::shape) return;
    auto* const cylinder = std::get_if<Cylinder>(&*object.shape);
    auto* const cone = std::get_if<Cone>(&*object.shape);
    if (!cylinder && !cone) return;
    DVec3 &base = cylinder ? cylinder->base : cone->base, &cap = cylinder ? cylinder->cap : cone->cap;
    const DVec3 way = cap - base;
    if (!(length(way) > 0)) return;
    double none = 1, &r = cone ? cone->base_radius : none, &s = cone ? cone->cap_radius : none;
    // Returns by which part of its length a body can become longer at an end: not beyond the tip of a cone.
    const auto room = [](double own, double other) {
        return own == 0 ? 0 : other > own ? std::min(1., own / (other - own) / 2) : 1;
    };
    const auto cut = [&](const DVec3& normal, const DVec3& point) {
        auto clip = std::make_shared<ObjectThing>();
        clip->kind = ObjectKind::shape, clip->place = object.place, clip->steps = object.steps;
        clip->shape = plane_of(normal, dot_product(normalize(normal), point));
        object.clips.push_back(std::move(clip));
    };
    const double before = room(r, s), behind = room(s, r), change = s - r;
    if (before > 0) cut(-way, base);
    if (behind > 0) cut(way, cap);
    base = base - before * way, cap = cap + behind * way;
    r -= before * change, s += behind * change;
}

/// Does no ray meet a body, as its faces have no extent?
static bool is_thin(const Shape& shape) {
    const auto same = [](const DVec3& a, const DVec3& b) { return (a.x == b.x) + (a.y == b.y) + (a.z == b.z); };
    if (const auto* const own = std::get_if<Sphere>(&shape)) return own->radius == 0;
    if (const auto* const own = std::get_if<Cuboid>(&shape)) return same(own->corner, own->opposite) > 1;
    if (const auto* const own = std::get_if<Cylinder>(&shape)) return own->radius == 0 && own->base != own->cap;
    if (const auto* const own = std::get_if<Cone>(&shape))
        return own->base_radius == 0 && own->cap_radius == 0 && own->base != own->cap;
    if (const auto* const own = std::get_if<Torus>(&shape)) return own->minor == 0;
    if (const auto* const own = std::get_if<Prism>(&shape)) return own->base != own->top && own->data->pieces.empty();
    if (const auto* const own = std::get_if<Disc>(&shape)) return own->hole >= own->radius || own->normal == DVec3(0);
    return (std::holds_alternative<Triangle>(shape) || std::holds_alternative<SmoothTriangle>(shape)) &&
           std::visit([](const auto& kind) { return kind.fault() != nullptr; }, shape);
}

/// Reads the arguments of a body after '{'.
void PovReader::read_shape(Interpreter& in, std::uint16_t code, ObjectThing& object) {
    in.form = form_of(code);
    const auto set = [&](const Shape& shape) {
        object.kind = ObjectKind::shape;
        object.shape = shape;
    };
    object.word = code;
    switch (code) {
        case word("sphere"): {
            const DVec3 centre = in.read_vector();
            const double radius = next_number(in);
            set(Sphere{centre, std::fabs(radius)});
            object.negative = radius < 0;
            break;
        }
        case word("box"): {
            const DVec3 corner = in.read_vector();
            set(box_between(corner, next_vector(in)));
            break;
        }
        case word("cylinder"): {
            const DVec3 base = in.read_vector(), cap = next_vector(in);
            set(Cylinder{base, cap, std::fabs(next_number(in))});
            break;
        }
        case word("cone"): {
            const DVec3 base = in.read_vector();
            const double base_radius = next_number(in);
            const DVec3 cap = next_vector(in);
            const double cap_radius = next_number(in);
            set(Cone{base, std::fabs(base_radius), cap, std::fabs(cap_radius)});
            if (base_radius * cap_radius < 0) object.approximated("a cone with radii of two signs, which has a waist");
            break;
        }
        case word("torus"): {
            const double major = in.read_number();
            set(Torus{DVec3(0), DVec3(0, 1, 0), std::fabs(major), std::fabs(next_number(in))});
            break;
        }
        case word("plane"): {
            const DVec3 normal = in.read_vector();
            const double distance = next_number(in);
            if (length(normal) > 0) set(plane_of(normal, distance));
            break;
        }
        case word("disc"): {
            const DVec3 centre = in.read_vector(), normal = next_vector(in);
            const double radius = next_number(in);
            in.skip_comma();
            set(Disc{centre, normal, std::fabs(radius), std::fabs(in.read_number_or(0))});
            break;
        }
        case word("triangle"): {
            const DVec3 a = in.read_vector(), b = next_vector(in), c = next_vector(in);
            set(Triangle{a, b, c});
            break;
        }
        case word("smooth_triangle"): {
            const DVec3 a = in.read_vector(), na = next_vector(in), b = next_vector(in), nb = next_vector(in),
                        c = next_vector(in), nc = next_vector(in);
            set(SmoothTriangle{a, b, c, na, nb, nc});
            break;
        }
        case word("polygon"):
            return read_polygon(in, object);
        case word("mesh"):
            return read_mesh(in, object);
        case word("mesh2"):
            return read_mesh2(in, object);
        default:
            if (read_surface(in, code, object) || read_implicit(in, code, object)) break;
            object.left_out("the body '" + std::string(reserved_words[code - first_word_code]) + "'");
            skip_arguments(in);
    }
    if (in.at(',')) in.misplaced();
    in.form = "";
    if (!object.shape || object.surface) return;
    const char* const fault = std::visit([](const auto& kind) { return kind.fault(); }, *object.shape);
    const bool thin = is_thin(*object.shape) || (fault && code == word("lathe"));
    if (!fault && !thin) return;
    object.kind = ObjectKind::nothing, object.thin = thin;
    if (!object.thin) object.left_out(std::string("a body without extent: ") + fault);
}

}  // namespace strahl::pov
