// The hierarchy of many bodies, and duplicates: built by any number of threads, and compared with a plain search.
#include "trace/hierarchy/hierarchy.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "files/error.h"
#include "num/thread_pool.h"
#include "scene/scene.h"
#include "tests/referee/random_pattern.h"
#include "tests/referee/referee.h"
#include "tests/unit/levels.h"
#include "tests/unit/sanitized.h"
#include "text/parse.h"
#include "trace/hierarchy/cut_triangles.h"
#include "trace/hierarchy/hierarchy_opening.h"
#include "trace/hierarchy/moving_hierarchy.h"
#include "trace/tracer.h"
#include "trace/world/build_world.h"
#include "trace/world/duplicate_bodies.h"
#include "trace/world/world.h"

using namespace strahl;

namespace {

/// Large enough for all threads to share the topmost nodes, and clustered: some splits are lopsided, some boxes equal.
std::vector<ItemBox> clustered_boxes(int count) {
    std::mt19937 random(7);
    std::vector<ItemBox> boxes(count);
    for (int i = 0; i < count; ++i) {
        const float spread = i % 3 == 0 ? 1000 : i % 3 == 1 ? 1 : 1e-3f;
        for (int c = 0; c < 3; ++c) {
            const float middle = spread * (static_cast<float>(random() % 2001) / 1000 - 1);
            boxes[i].low[c] = middle - (i % 5 == 0 ? 0 : .01f), boxes[i].high[c] = middle + .01f;
        }
        boxes[i].form = i / 5 % 3;
        if (i % 10 == 0 && i > 500) boxes[i] = boxes[500];
    }
    return boxes;
}

Hierarchy built(std::vector<ItemBox> boxes, double margin, int threads, int lanes = 1) {
    ThreadPool pool(threads);
    Buffer<ItemBox> copies = uninitialized_buffer<ItemBox>(boxes.size());
    std::copy(boxes.begin(), boxes.end(), copies.get());
    return build_hierarchy(std::move(copies), static_cast<std::int32_t>(boxes.size()), margin, pool, lanes);
}

bool holds(const Node& node, int child, const ItemBox& box, float margin) {
    for (int c = 0; c < 3; ++c)
        if (node.low[c][child] > box.low[c] - margin || node.high[c][child] < box.high[c] + margin) return false;
    return true;
}

/// Is every item in one leaf of items of its form, and does every box around it contain it with the margin?
void check_hierarchy(const Hierarchy& hierarchy, const std::vector<ItemBox>& boxes, float margin) {
    const int count = static_cast<int>(boxes.size());
    std::vector<int> met(count, 0), parent(hierarchy.size, -1), child(hierarchy.size, -1);
    for (int n = 0; n < hierarchy.size; ++n)
        for (int c = 0; c < hierarchy.nodes[n].children; ++c)
            if (hierarchy.nodes[n].leaves[c] == 0) {
                const int below = hierarchy.nodes[n].first[c];
                REQUIRE((below > 0 && below < hierarchy.size));
                CHECK(parent[below] == -1);
                parent[below] = n, child[below] = c;
            }
    int lost = 0, deepest = 0, others = 0;
    for (int n = 0; n < hierarchy.size; ++n)
        for (int c = 0; c < hierarchy.nodes[n].children; ++c)
            for (int i = 0; i < LeafCode::items(hierarchy.nodes[n].leaves[c]); ++i) {
                const int item = hierarchy.order[hierarchy.nodes[n].first[c] + i];
                ++met[item];
                others += boxes[item].form != LeafCode::form(hierarchy.nodes[n].leaves[c]);
                int level = 1;
                for (int at = n, by = c; at >= 0; by = child[at], at = parent[at], ++level)
                    lost += !holds(hierarchy.nodes[at], by, boxes[item], margin);
                deepest = std::max(deepest, level);
            }
    CHECK(lost == 0);
    CHECK(others == 0);
    CHECK(deepest <= Hierarchy::most_levels);
    CHECK(std::count(met.begin(), met.end(), 1) == count);
}

}  // namespace

TEST_CASE("every item is in one leaf of items of its form, and all boxes around it contain it with the margin") {
    for (const int count : {1, 2, 17, 300, 60000}) {
        const std::vector<ItemBox> boxes = clustered_boxes(count);
        check_hierarchy(built(boxes, .25, 2), boxes, .25f);
    }
}

TEST_CASE("each composite is in a leaf of its own") {
    constexpr int composites = place_of<CompositeForm>(Forms{});
    for (const int count : {2, 17, 300}) {
        std::vector<ItemBox> boxes = clustered_boxes(count);
        for (int i = 0; i < count; ++i)
            if (i % 2 == 0) boxes[i].form = composites;
        const Hierarchy hierarchy = built(boxes, 0, 2);
        check_hierarchy(hierarchy, boxes, 0);
        int alone = 0;
        for (const Node* node = hierarchy.nodes.get(); node < hierarchy.nodes.get() + hierarchy.size; ++node)
            for (const int code : node->leaves) alone += code == LeafCode::make(composites, 1);
        CHECK(alone == (count + 1) / 2);
    }
}

TEST_CASE("leaves hold more triangles, but no more of other bodies, if single rays test sixteen side by side") {
    for (const int form : {place_of<Form<Triangle, 0>>(Forms{}), place_of<Form<Sphere, 0>>(Forms{})}) {
        std::vector<ItemBox> boxes = clustered_boxes(5000);
        for (ItemBox& box : boxes) box.form = form;
        int leaves[2]{};
        for (const int lanes : {8, 16}) {
            const Hierarchy hierarchy = built(boxes, 0, 1, lanes);
            check_hierarchy(hierarchy, boxes, 0);
            for (const Node* node = hierarchy.nodes.get(); node < hierarchy.nodes.get() + hierarchy.size; ++node)
                for (const int code : node->leaves) leaves[lanes / 16] += code != 0;
        }
        CHECK((leaves[1] < leaves[0]) == (form == place_of<Form<Triangle, 0>>(Forms{})));
    }
}

TEST_CASE("many boxes with centres in a plane, on a line, in one place and in two are in a hierarchy") {
    for (const int different : {2, 1, 0}) {
        std::vector<ItemBox> boxes = clustered_boxes(40000);
        for (ItemBox& box : boxes)
            for (int c = different; c < 3; ++c) box.low[c] = -1, box.high[c] = 1;
        check_hierarchy(built(boxes, 0, 2), boxes, 0);
        for (std::size_t i = 0; i < boxes.size(); i += 2) boxes[i].low[2] += 10, boxes[i].high[2] += 10;
        check_hierarchy(built(boxes, 0, 2), boxes, 0);
    }
}

TEST_CASE("a hierarchy is fitted to items that move, and built anew where they have changed places") {
    ThreadPool pool(2);
    std::vector<ItemBox> boxes = clustered_boxes(60000);
    std::ranges::sort(boxes, {}, &ItemBox::form);
    std::vector<std::int32_t> starts{0, 0, 0, 60000};
    for (const int form : {0, 1})
        starts[form + 1] =
            static_cast<std::int32_t>(std::ranges::upper_bound(boxes, form, {}, &ItemBox::form) - boxes.begin());
    MovingHierarchy moving;
    const auto fitted = [&] {
        Buffer<ItemBox> copies = uninitialized_buffer<ItemBox>(boxes.size());
        std::copy(boxes.begin(), boxes.end(), copies.get());
        return moving.fit(std::move(copies), starts, .25, pool);
    };
    const auto same_leaves = [&](const Hierarchy& a, const Hierarchy& b) {
        return a.size == b.size && std::equal(a.order.get(), a.order.get() + boxes.size(), b.order.get());
    };
    const auto move = [&](ItemBox& box, float by) { box.low[1] += by, box.high[1] += by; };
    const Hierarchy first = fitted();
    CHECK(same_leaves(first, built(boxes, .25, 1)));
    std::mt19937 random(5);
    for (ItemBox& box : boxes) move(box, 1e-3f * static_cast<float>(random() % 3));
    const Hierarchy second = fitted();
    CHECK(same_leaves(second, first));
    check_hierarchy(second, boxes, .25f);
    for (ItemBox& box : boxes) move(box, static_cast<float>(random() % 2000));
    const Hierarchy third = fitted();
    CHECK(!same_leaves(third, first));
    CHECK(same_leaves(third, built(boxes, .25, 1)));
    // Leaves hold items of one form: after a change of forms the earlier leaves would be wrong.
    boxes[starts[1]].form = 0, ++starts[1];
    check_hierarchy(fitted(), boxes, .25f);
}

TEST_CASE(
    "wide nodes are made of binary ones at the cost that was expected, and never at more than by opening the largest") {
    using hierarchy_cut::OpenedPart;
    using Parts = std::vector<OpenedPart>;
    std::mt19937 random(11);
    const auto area = [](const OpenedPart& part) { return double(part.box.half_area()); };
    int better = 0;
    for (int count = 2; count < 200; ++count) {
        Parts parts(count);
        std::vector<int> loose(count);
        for (int i = 0; i < count; ++i) {
            const float size = std::exp(static_cast<float>(random() % 1000) / 200);
            for (int c = 0; c < 3; ++c)
                parts[i].box.low[c] = static_cast<float>(random() % 100),
                parts[i].box.high[c] = parts[i].box.low[c] + size;
            parts[i].code = 1, loose[i] = i;
        }
        while (loose.size() > 1) {
            std::shuffle(loose.begin(), loose.end(), random);
            OpenedPart whole{parts[loose[0]].box};
            whole.box.add(parts[loose[1]].box);
            for (int h = 0; h < 2; ++h) whole.halves[h] = loose[h];
            whole.join(parts[loose[0]], parts[loose[1]]);
            loose.erase(loose.begin()), loose[0] = static_cast<int>(parts.size());
            parts.push_back(whole);
        }
        const auto least = [](const Parts& all, const OpenedPart& whole) {
            std::vector<const OpenedPart*> children;
            open_part(all, whole, Node::width, children);
            return children;
        };
        const auto largest = [&](const Parts& all, const OpenedPart& whole) {
            std::vector<const OpenedPart*> children{&whole};
            while (children.size() < Node::width) {
                const auto most = std::ranges::max_element(
                    children, {}, [&](const OpenedPart* part) { return part->code != 0 ? -1 : area(*part); });
                const OpenedPart& part = **most;
                if (part.code != 0) break;
                *most = &all[part.halves[0]];
                children.push_back(&all[part.halves[1]]);
            }
            return children;
        };
        const auto cost = [&](const auto& open) {
            double sum = 0;
            std::vector<const OpenedPart*> nodes{&parts.back()};
            int leaves = 0;
            while (!nodes.empty()) {
                const OpenedPart& node = *nodes.back();
                nodes.pop_back(), sum += area(node);
                const auto children = open(parts, node);
                CHECK((children.size() > 1 && children.size() <= Node::width));
                for (const OpenedPart* child : children) child->code != 0 ? void(++leaves) : nodes.push_back(child);
            }
            CHECK(leaves == count);
            return sum;
        };
        const double made = cost(least);
        CHECK(made == doctest::Approx(parts.back().cost[1]).epsilon(1e-5));
        CHECK(made <= cost(largest) * 1.00001);
        better += made < .9 * cost(largest);
    }
    CHECK(better > 20);
}

TEST_CASE("the hierarchy does not depend on the number of threads") {
    const std::vector<ItemBox> boxes = clustered_boxes(60000);
    const Hierarchy one = built(boxes, 1e-6, 1);
    for (const int threads : {2, 3, 5}) {
        const Hierarchy many = built(boxes, 1e-6, threads);
        REQUIRE(many.size == one.size);
        CHECK(std::equal(many.order.get(), many.order.get() + boxes.size(), one.order.get()));
        int apart = 0;
        for (int n = 0; n < one.size; ++n)
            for (int c = 0; c < one.nodes[n].children; ++c) {
                const auto numbers = [c](const Node& node) {
                    return std::tuple(node.children, node.first[c], node.leaves[c], node.low[0][c], node.low[1][c],
                                      node.low[2][c], node.high[0][c], node.high[1][c], node.high[2][c]);
                };
                apart += numbers(one.nodes[n]) != numbers(many.nodes[n]);
            }
        CHECK(apart == 0);
    }
}

TEST_CASE("a large mesh, made by all threads, is the same as its halves") {
    Scene scene = parse_scene(R"(
        camera { position <0, -3, 2> look_at <0, 0, 0> up <0, 0, 1> fov 45 }
        light { position <-4, -6, 8> color <1, 1, 1> }
        defaultmaterial { rgb <1, .5, .2> diffuse .6 reflection .3 }
        sphere { <0, 0, 1>, .3 } cylinder { <-1, 0, .5>, <1, 0, .5>, .1 })",
                              "text");
    const Primitive last = scene.primitives.back();
    scene.primitives.pop_back();
    constexpr int side = 60;
    MeshData whole;
    for (int i = 0; i < side * side; ++i)
        whole.points.push_back({i % side * .034 - 1, i / side * .034 - 1, .1 * std::sin(i * .3)}),
            whole.normals.push_back({std::cos(i), std::sin(i), 3});
    for (int i = 0; i + side + 1 < side * side; ++i)
        if (i % side + 1 < side)
            whole.triangles.push_back({i, i + 1, i + side}), whole.triangles.push_back({i + 1, i + side + 1, i + side});
    const auto middle = static_cast<std::ptrdiff_t>(whole.triangles.size() / 2);
    for (const bool smooth : {false, true}) {
        if (smooth) whole.corner_normals = whole.triangles;
        MeshData halves[2]{whole, whole};
        for (std::vector<MeshData::Corners> MeshData::*const list : {&MeshData::triangles, &MeshData::corner_normals})
            if (auto& first = halves[0].*list, &second = halves[1].*list; !first.empty())
                first.erase(first.begin() + middle, first.end()), second.erase(second.begin(), second.begin() + middle);
        const auto picture = [&](const std::vector<MeshData>& meshes, Precision precision) {
            Scene own = scene;
            for (const MeshData& mesh : meshes)
                own.primitives.push_back({Mesh{std::make_shared<const MeshData>(mesh), ""}, last.material, {}});
            own.primitives.push_back(last);
            return render(own, {.camera = own.camera, .width = 64, .height = 48, .depth = 3}, precision, 3);
        };
        for (const Precision precision : {Precision::float32, Precision::float64})
            CHECK(picture({whole}, precision) == picture({halves[0], halves[1]}, precision));
    }
}

TEST_CASE("every point of a triangle is in a box of one of its pieces, and these are within its box") {
    std::mt19937 random(5);
    const auto number = [&] { return static_cast<double>(random() % 2001) / 1000 - 1; };
    int missed = 0, beyond = 0;
    std::size_t most = 0;
    for (int i = 0; i < 300; ++i) {
        TriangleCorners corners;
        for (DVec3& corner : corners) corner = {number(), i % 3 == 0 ? .5 : number(), number()};
        if (i % 2 == 0) corners[2] = corners[0] + .01 * DVec3(number(), number(), number());
        Box box;
        for (const DVec3& corner : corners) box.add(corner);
        const DVec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double shadows = (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) / 2;
        std::vector<Box> pieces;
        cut_triangle(corners, box, shadows, .01, 8, pieces);
        most = std::max(most, pieces.size());
        const auto in = [](const Box& b, const DVec3& p, double more) {
            for (int c = 0; c < 3; ++c)
                if (!(p[c] >= b.low[c] - more && p[c] <= b.high[c] + more)) return false;
            return true;
        };
        for (const Box& piece : pieces) beyond += !in(box, piece.low, 0) || !in(box, piece.high, 0);
        for (int k = 0; k < 200; ++k) {
            const double a = (number() + 1) / 2, b = (number() + 1) / 2 * (1 - a);
            const DVec3 point = a * corners[0] + b * corners[1] + (1 - a - b) * corners[2];
            missed += std::ranges::none_of(pieces, [&](const Box& piece) { return in(piece, point, 1e-14); });
        }
    }
    CHECK(missed == 0);
    CHECK(beyond == 0);
    CHECK(most > 16);
}

TEST_CASE("long triangles, cut in pieces, are seen as whole ones are") {
    std::mt19937 random(9);
    const auto number = [&] { return static_cast<double>(random() % 20001) / 10000 - 1; };
    for (const bool smooth : {false, true}) {
        MeshData sticks;
        for (int i = 0; i < 9000; ++i) {
            const DVec3 from(number(), number(), number());
            const double length = i % 20 == 0 ? 1 : .05;
            const DVec3 to = i % 20 == 0 ? DVec3(number(), number(), number()) : from + .05 * DVec3(number(), 1, 1);
            sticks.points.insert(sticks.points.end(), {from, to, from + .02 * length * DVec3(number(), number(), 1)});
            sticks.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
            for (int k = 0; k < 3; ++k) sticks.normals.push_back({number(), number(), number() + 3});
        }
        if (smooth) sticks.corner_normals = sticks.triangles;
        const auto scene = [&](const char* more) {
            Scene own = parse_scene(std::string(R"(
                camera { position <0, -3, 2> look_at <0, 0, 0> up <0, 0, 1> fov 45 }
                light { position <-4, -6, 8> color <1, 1, 1> }
                defaultmaterial { rgb <1, .5, .2> diffuse .6 reflection .3 })") +
                                        more + "sphere { <0, 0, 0>, .1 }",
                                    "text");
            const int material = own.primitives.back().material;
            own.primitives.push_back({Mesh{std::make_shared<const MeshData>(sticks), ""}, material, {}});
            return own;
        };
        // Adds a body that no ray of the picture meets; a transparent one keeps all triangles whole, since colours are
        // multiplied each time that a body is met.
        const Scene cut = scene("sphere { <0, -9, 0>, .1 }"),
                    whole = scene("sphere { <0, -9, 0>, .1 material { refraction .5 ior 1 } }");
        ThreadPool pool(2);
        const auto triangles = [&](const Scene& own, bool proves = false) {
            const BuiltWorld<float> built(own, {}, pool, nullptr, nullptr, proves);
            return built.world().groups.get<Form<Triangle, 0>>().count +
                   built.world().groups.get<Form<SmoothTriangle, 0>>().count;
        };
        CHECK(triangles(whole) == 9000);
        CHECK(triangles(cut, true) == 9000);  // proofs look for two bodies in one place
        CHECK(triangles(cut) > 11000);
        const View view{.camera = cut.camera, .width = 160, .height = 120, .depth = 4};
        for (const Precision precision : {Precision::float32, Precision::float64})
            for (const Simd simd : fused_levels()) {
                const Frame picture = render(cut, view, precision, 2, simd);
                CHECK(picture == render(whole, view, precision, 1, simd));
            }
    }
}

TEST_CASE("duplicates are exactly the bodies that were declared before") {
    using Ball = Item<Form<Sphere, 0>, float>;
    std::mt19937 random(3);
    std::vector<Ball> balls(20000);
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const auto number = [&] { return static_cast<float>(random() % 20) - 10; };
        const float x = number(), y = number(), z = number();
        balls[i] = {{{x, y, z}, static_cast<float>(1 + random() % 10)}, static_cast<float>(i), 0};
        if (i % 3 == 0) balls[i].shape.centre = -balls[i].shape.centre;  // zeros of either sign
    }
    std::set<std::tuple<float, float, float, float>> before;
    std::vector<std::int32_t> expected;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const auto& [centre, radius] = balls[i].shape;
        if (!before.emplace(centre.x, centre.y, centre.z, radius).second) expected.push_back(int(i));
    }
    REQUIRE(expected.size() > 1000);
    for (const int threads : {1, 3}) {
        ThreadPool pool(threads);
        CHECK(duplicates(&balls[0].shape.centre.x, int(balls.size()), 6, 4, pool) == expected);
        CHECK(duplicates(&balls[0].shape.centre.x, 0, 6, 4, pool).empty());
    }
}

TEST_CASE("a scene of more surfaces than float can number is refused, with what to do") {
    if (sanitized()) return;  // 300 MB
    Scene scene;
    scene.primitives.resize((1 << 24) / Cuboid::faces, {Cuboid{}, 0, {}});
    CHECK_NOTHROW(check_capacity(scene, Precision::float32));
    scene.primitives.push_back({Cuboid{}, 0, {}});
    CHECK_THROWS_WITH_AS(check_capacity(scene, Precision::float32), doctest::Contains("--precision double"), FileError);
    CHECK_NOTHROW(check_capacity(scene, Precision::float64));
}

TEST_CASE("round bodies that hardly lean are within their boxes") {
    for (const double lean : {1., 1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
        CAPTURE(lean);
        const DVec3 axis{0, lean, 1};
        const double sine = lean / std::sqrt(1 + lean * lean), rim = .999999999 * 3 * sine;
        CHECK(Disc{{0, 0, 0}, axis, 3, 0}.bounds().high.z >= rim);
        CHECK(Torus{{0, 0, 0}, axis, 3, 1e-20}.bounds().high.z >= rim);
        CHECK(Cylinder{-axis, {0, 0, 0}, 3}.bounds().high.z >= rim);
        CHECK(Cone{-axis, 1, {0, 0, 0}, 3}.bounds().high.z >= rim);
    }
}

TEST_CASE("the boxes of a hierarchy hold bodies however small coordinates are") {
    for (const double x : {1.1, 1e-30, 1e-40, 6.24e-45, 1e-46}) {
        CAPTURE(x);
        const Hierarchy hierarchy = built({item_box(Box{DVec3(x), DVec3(x)}, 0)}, 0, 1);
        CHECK(hierarchy.nodes[0].low[0][0] < x);
        CHECK(hierarchy.nodes[0].high[0][0] > x);
    }
}

TEST_CASE("rays from the far side of a part far larger than the other bodies") {
    // In float, rays meet the box and the rod at distances whose errors are larger than these bodies.
    const Scene scene = parse_scene(R"(
        camera { position <5.5, 0, 0> look_at <0, 0, 0> up <0, 1, 0> fov 45 }
        box { <0, 0, 1>, <1, 1, 0> }
        union {
          sphere { <0, -.845219132480084, -1>, 25529607.089063216
            material { normal image { "1-7-109" map spherical scale .2
              rotate <-70.22148176685813, -70.67283933075757, 113.58161125184893> } } }
          plane { <2.245337251199974, 0, 2>, <.47930883524154044, 1, 2.4765051087822503>, <2, 1, 1> }
        }
        cylinder { <1, -2.6, 0>, <0, 0, 0>, 2 material { ambient 1 } })",
                                    "text", {}, made_up_pixels);
    const View view{.camera = scene.camera, .width = 280, .height = 240, .depth = 2};
    const Frame scalar = render(scene, view, Precision::float32, 1, Simd::scalar);
    for (const Simd simd : fused_levels()) CHECK(render(scene, view, Precision::float32, 1, simd) == scalar);
}
