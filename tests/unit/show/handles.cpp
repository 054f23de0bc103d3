// Handles, the marks of lights, and the texts that drags make, without a window.
#include "show/session/handles.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "num/vec_math.h"
#include "scene/overlap.h"
#include "show/session/body_editor.h"
#include "show/session/drag.h"
#include "show/session/light_marks.h"
#include "tests/unit/show/show_scene.h"

using namespace strahl;

namespace {

constexpr std::array<DVec3, 3> world{DVec3(1, 0, 0), DVec3(0, 1, 0), DVec3(0, 0, 1)};

View wide_view(const Scene& scene) { return {.camera = scene.camera, .width = 640, .height = 480}; }

double pixels_between(const glm::dvec2& a, const glm::dvec2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Returns a point of the longest line of a handle, at this share of its points.
glm::dvec2 point_of(const Handles& handles, Handle handle, double share = 1) {
    const Handles::HandleLine* longest = nullptr;
    for (const Handles::HandleLine& line : handles.lines())
        if (line.handle == handle && (!longest || line.points.size() > longest->points.size()) &&
            (!line.filled || handle == Handle::all))
            longest = &line;
    REQUIRE(longest);
    return longest->points[std::size_t(share * double(longest->points.size() - 1))];
}

}  // namespace

TEST_CASE("a point is seen where the ray through that pixel meets it") {
    const auto scene = shown_scene();
    View view = wide_view(*scene);
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        view.camera.projection = projection;
        const auto ray = ray_at(view, 123, 321);
        for (const double t : {.5, 3., 20.}) {
            const auto place = place_in(view, ray.origin + t * ray.direction);
            REQUIRE(place);
            CHECK(pixels_between(*place, {123, 321}) < 1e-6);
        }
        CHECK(!place_in(view, ray.origin - ray.direction));
        CHECK(!place_in(view, ray.origin));
    }
    view.camera.projection = Projection::spherical;
    CHECK(!place_in(view, view.camera.look_at));
}

TEST_CASE("handles of an orthographic view move what is dragged to the pointer") {
    const auto scene = shown_scene();
    View view = wide_view(*scene);
    view.camera.projection = Projection::orthographic;
    const DVec3 centre(1, -2, 1.5);
    const Handles handles(HandleMode::move, centre, world, 80, view);
    const glm::dvec2 middle = *place_in(view, centre), to = middle + glm::dvec2(60, -35);
    const auto moved = std::get<MoveBy>(handles.drag(Handle::all, middle, to, false));
    CHECK(pixels_between(*place_in(view, centre + moved.by), to) < 1e-6);
    CHECK(handles.at(middle, 8) == Handle::all);
}

TEST_CASE("handles move what is dragged to the pointer: across the view, and along an axis") {
    const auto scene = shown_scene();
    const View view = wide_view(*scene);
    const DVec3 centre(1, -2, 1.5);
    const Handles handles(HandleMode::move, centre, world, 80, view);
    const glm::dvec2 middle = *place_in(view, centre), to = middle + glm::dvec2(60, -35);
    CHECK(handles.at(middle, 8) == Handle::all);
    CHECK(!handles.at(middle + glm::dvec2(0, 150), 8));
    const auto across = std::get<MoveBy>(handles.drag(Handle::all, middle, to, false));
    CHECK(pixels_between(*place_in(view, centre + across.by), to) < 1e-6);
    for (const Handle handle : {Handle::x, Handle::y, Handle::z}) {
        const int axis = static_cast<int>(handle);
        const glm::dvec2 from = point_of(handles, handle);
        CHECK(handles.at(from, 4) == handle);
        CHECK(std::abs(pixels_between(from, middle)) <= 110);
        // Drags the handle to a point of its axis that is further out.
        DVec3 far = centre;
        far[axis] += 2.5;
        const glm::dvec2 way = *place_in(view, far) - middle;
        const auto along = std::get<MoveBy>(handles.drag(handle, middle, middle + way, false));
        CHECK(along.by[axis] == doctest::Approx(2.5));
        CHECK(length(along.by) == doctest::Approx(2.5));
        const auto stepped = std::get<MoveBy>(handles.drag(handle, middle, middle + 1.03 * way, true));
        CHECK(stepped.by[axis] == doctest::Approx(2.5).epsilon(.1));
        CHECK(std::abs(stepped.by[axis] * 20 - std::round(stepped.by[axis] * 20)) < 1e-9);
    }
    CHECK(Handles(HandleMode::move, 2. * view.camera.position, world, 80, view).lines().empty());
}

TEST_CASE("circles turn what is dragged along them, and squares scale") {
    const auto scene = shown_scene();
    const View view = wide_view(*scene);
    const DVec3 centre(0, 0, 1);
    const Handles turning(HandleMode::turn, centre, world, 80, view);
    const DVec3 to_eye = normalize(view.camera.position - centre);
    for (const Handle handle : {Handle::x, Handle::y, Handle::z}) {
        const glm::dvec2 from = point_of(turning, handle, .4);
        CHECK(turning.at(from, 4) == handle);
        // A point that turns with the body follows the pointer along the tangent.
        const int axis = static_cast<int>(handle);
        const auto ray = ray_at(view, from.x, from.y);
        const double t = (centre[axis] - ray.origin[axis]) / ray.direction[axis];
        const DVec3 held = ray.origin + t * ray.direction - centre;
        const DVec3 next = centre + held + .02 * cross_product(world[std::size_t(axis)], held);
        const auto turn = std::get<TurnBy>(turning.drag(handle, from, *place_in(view, next), false));
        CHECK(turn.degrees == doctest::Approx(.02 * 180 / M_PI).epsilon(.15));
        CHECK(turn.axis == world[std::size_t(axis)]);
        CHECK(turn.about == centre);
        CHECK(std::remainder(std::get<TurnBy>(turning.drag(handle, from, from + glm::dvec2(40, 30), true)).degrees,
                             15) == 0);
    }
    const glm::dvec2 middle = *place_in(view, centre);
    const auto round =
        std::get<TurnBy>(turning.drag(Handle::all, middle + glm::dvec2(90, 0), middle + glm::dvec2(0, -90), false));
    CHECK(round.degrees == doctest::Approx(90));
    CHECK(dot_product(round.axis, to_eye) > .99);

    const Handles scaling(HandleMode::scale, centre, world, 80, view);
    const glm::dvec2 end = *place_in(view, centre + DVec3(0, 0, 1)) - middle;
    const glm::dvec2 tip = point_of(scaling, Handle::z);
    const double reach = pixels_between(tip, middle) / std::hypot(end.x, end.y);
    const auto scale = std::get<ScaleBy>(scaling.drag(Handle::z, tip, middle + 2 * reach * end, false));
    CHECK(scale.factors.x == 1);
    CHECK(scale.factors.z == doctest::Approx(2).epsilon(.05));
    const auto even = std::get<ScaleBy>(scaling.drag(Handle::all, middle, middle + glm::dvec2(40, 0), true));
    CHECK(even.factors == DVec3(1.5));
    CHECK(std::get<ScaleBy>(scaling.drag(Handle::all, middle, middle - glm::dvec2(900, 0), false)).factors.x > 0);
}

TEST_CASE("a body follows the pointer, and undo takes back the whole drag") {
    const auto scene = shown_scene();
    const View view = wide_view(*scene);
    EditOrder order;
    BodyEditor editor;
    editor.open(scene_text);
    const glm::dvec2 on_ball = *place_in(view, {0, 0, 2});
    editor.click(*scene, *scene, view, on_ball.x, on_ball.y);
    REQUIRE(editor.choice()->at.body == 0);
    const Handles handles(HandleMode::move, world_bounds(scene->primitives[0]).centre(), world, 80, view);
    std::string why;
    const auto drag = Drag::begin(editor, *scene, handles, Handle::all, on_ball, why);
    REQUIRE(drag);
    glm::dvec2 to = on_ball;
    for (int i = 1; i <= 20; ++i) {
        to = on_ball + glm::dvec2(4 * i, 3 * i);
        editor.edited.change(drag->text(drag->placing(to, false), false), {order, "drag", i > 1});
        editor.look(*scene);
    }
    const Scene moved = parse_scene(editor.edited.text(), "test");
    CHECK(pixels_between(*place_in(view, std::get<Sphere>(moved.primitives[0].shape).centre), to) < 1);
    CHECK(editor.edited.unwritten().size() == 1);
    const DVec3 before = editor.choice()->point;
    editor.move_point(before + DVec3(0, 0, 3));
    CHECK(editor.edited.undo(true, order));
    CHECK(editor.edited.text() == scene_text);
    editor.find_point(*scene);
    CHECK(length(editor.choice()->point - before) < 1e-9);
    CHECK(!editor.edited.undo(true, order));
}

TEST_CASE("lights have marks that can be chosen and dragged; those that move or have no place say so") {
    const std::string lights =
        "light { position <2, 0, 3> color <2, 1, 0> spot { look_at <0, 0, 0> } }\n"
        "light { direction <0, 0, -1> color <1, 1, 1> }\n"
        "light { position <1, 1, 1> color <1, 1, 1> motion { key { time 0 } "
        "key { time 2 translate <1, 0, 0> } } }\n";
    const auto scene = shown_scene(lights);
    const View view = wide_view(*scene);
    const LightMarks all = light_marks(*scene, view);
    REQUIRE(all.marks.size() == 4);
    CHECK(all.lines.size() == 2);
    CHECK(all.marks[1].color == Color(1, .5, 0));
    const LightPoint target{1, true};
    const glm::dvec2 place = *place_in(view, {0, 0, 0});
    CHECK(mark_at(all, place + glm::dvec2(3, 2), 12) == target);
    CHECK(!mark_at(all, place + glm::dvec2(30, 2), 12));
    BodyEditor editor;
    editor.open(scene_text + lights);
    editor.choose(target, *scene);
    CHECK(editor.body().kind == "spotlight");
    CHECK(!editor.choice());
    std::string why;
    const auto drag_of = [&](const LightPoint& point) {
        editor.choose(point, *scene);
        const Handles handles(HandleMode::move, position_of(*scene, point), world, 80, view);
        return Drag::begin(editor, *scene, handles, Handle::all, place, why);
    };
    const auto drag = drag_of(target);
    REQUIRE(drag);
    const Scene moved = parse_scene(drag->text(drag->placing(place + glm::dvec2(50, 20), false), false), "test");
    CHECK(pixels_between(*place_in(view, moved.lights[1].spot->look_at), place + glm::dvec2(50, 20)) < 1);
    CHECK(moved.lights[1].position == DVec3(2, 0, 3));
    // Circles turn the spotlight about the end of its axis that is chosen.
    for (const bool by_target : {false, true}) {
        const LightPoint point{1, by_target};
        editor.choose(point, *scene);
        const Handles circles(HandleMode::turn, position_of(*scene, point), world, 80, view);
        const glm::dvec2 middle = *place_in(view, position_of(*scene, point));
        const auto turn = Drag::begin(editor, *scene, circles, Handle::all, middle + glm::dvec2(90, 0), why);
        REQUIRE(turn);
        const Light spot =
            parse_scene(turn->text(turn->placing(middle + glm::dvec2(0, -90), true), true), "test").lights[1];
        const DVec3 stays = by_target ? spot.spot->look_at : spot.position;
        CHECK(stays == position_of(*scene, point));
        CHECK(length(spot.position - spot.spot->look_at) == doctest::Approx(std::sqrt(13.)).epsilon(.01));
        const DVec3 other = by_target ? spot.position : spot.spot->look_at;
        CHECK(length(other - position_of(*scene, {1, !by_target})) > 1);
    }
    // The light's circles open its cone: the outer one as far as the pointer says, the inner one no further than that.
    editor.choose(target, *scene);
    const Light& aimed = scene->lights[1];
    const Handles cone(aimed.position, *aimed.spot, view);
    for (const Handle handle : {Handle::all, Handle::y}) {
        const glm::dvec2 from = point_of(cone, handle, .25);
        CHECK(cone.at(from, 3) == handle);
        const auto open = Drag::begin(editor, *scene, cone, handle, from, why);
        REQUIRE(open);
        const auto at_factor = [&](double factor) {
            return *parse_scene(open->text(open->placing(place + factor * (from - place), false), false), "test")
                        .lights[1]
                        .spot;
        };
        const Spot wider = at_factor(1.2), narrower = at_factor(.8);
        const bool outer = handle == Handle::all;
        CHECK((outer ? wider.falloff : narrower.radius) ==
              doctest::Approx(outer ? 50.2 : std::atan(.8 * std::sqrt(1 / 3.)) * 180 / std::acos(-1)).epsilon(.002));
        CHECK((outer ? at_factor(.01).falloff : at_factor(100).radius) == (outer ? 30 : 45));
        CHECK((outer ? wider.radius : wider.falloff) == (outer ? 30 : 45));
    }
    // Parallel light is turned.
    editor.choose({2, false}, *scene);
    const Handles circles(HandleMode::turn, {0, 0, 0}, world, 80, view);
    const auto turn = Drag::begin(editor, *scene, circles, Handle::all, place + glm::dvec2(90, 0), why);
    REQUIRE(turn);
    const DVec3 direction =
        *parse_scene(turn->text(turn->placing(place + glm::dvec2(0, -90), true), true), "test").lights[2].direction;
    CHECK(length(direction) == doctest::Approx(1).epsilon(.001));
    CHECK(std::abs(dot_product(direction, DVec3(0, 0, -1))) < .5);
    CHECK(!drag_of({3, false}));
    CHECK(why == "this light has a motion, which is changed in the text");
    CHECK(drag_of({0, false}));
    // A light that is no longer there is no longer chosen.
    editor.look(*shown_scene());
    CHECK(editor.light());
    editor.choose({3, false}, *scene);
    editor.look(*shown_scene());
    CHECK(!editor.any());
}
