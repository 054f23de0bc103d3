// Each formula of mirrors, glass, light, boxes and candidates on its own, as formulas_of_bodies.cpp has those of
// bodies.
#include "num/thread_pool.h"
#include "tests/proof/trial.h"
#include "trace/world/build_world.h"

using namespace strahl;
using namespace strahl::trial;

namespace {

/// A hit as the kernel has it, what is known of it, and what it is in exact arithmetic.
struct OffHit {
    MaterialKernel<double> material;
    Vector position, normal, direction;
    HitBounds<double> known;
    Hit<double> hit;

    OffHit(Dice& dice, const MaterialKernel<double>& own)
        : material(own), hit{true, {}, {}, {}, true, 0, 0, 0, 1, 0, material, true, 0} {
        hit.position = dice.vector(-3, 3);
        const Vector n = unit(Vector(dice.direction()));
        const R c = std::pow(10, dice.in(dice.chance(.3) ? -6 : -1, 0));
        hit.normal = nearly_unit(dice, n);
        hit.direction = nearly_unit(dice, root(1 - c * c) * perpendicular(dice, n) - c * n);
        const Vector turned = any_of(dice, vector(hit.direction)), tilted = any_of(dice, vector(hit.direction));
        position = Vector(hit.position) + R(any_size(dice)) * any_of(dice, n);
        normal = unit(vector(hit.normal) + R(any_size(dice)) * tilted);
        direction = unit(vector(hit.direction) + R(any_size(dice)) * turned);
        known.away = above(length(position - vector(hit.position)));
        known.normal = known.mirrored = above(length(normal - vector(hit.normal)));
        known.turn = turn_from(direction, hit.direction);
        known.side = above(length(cross(apart(), direction))), known.height = above(size(dot(apart(), normal)));
        known.followed = true;
    }
    Vector apart() const { return position - vector(hit.position); }
    bool ahead() const { return dot(direction, normal) < 0; }
    Vector mirrored() const { return direction - 2 * dot(direction, normal) * normal; }
};

MaterialKernel<double> material_of(Dice& dice) {
    MaterialKernel<double> material{};
    material.diffuse = Vec3<double>(dice.in(0, 1)), material.specular = dice.in(.1, 1);
    material.pow = std::floor(std::pow(10, dice.in(0, 2.5)));
    if (dice.chance(.2)) material.pow = dice.in(.01, 1);
    material.shines_from = std::pow(std::numeric_limits<double>::epsilon() / 64, 1 / material.pow);
    material.ior = dice.chance(.5) ? dice.in(1, 2.5) : std::pow(16, dice.in(0, 1));
    return material;
}

Vector direction_of(const OffHit& off, const Vec3<double>& direction) {
    return unit(vector(branch<Plain>(off.hit, true, direction, 1., 0.).direction));
}

}  // namespace

TEST_CASE("formulas of mirrors and glass") {
    Closest mirror{"mirrored direction"}, mirrored_line{"mirrored line"}, glass{"refracted direction"},
        refracted_line{"refracted line"}, square{"squared cosine beyond"}, total{"total, or not"};
    Dice dice(4);
    for (int i = 0; i < trials(); ++i) {
        const OffHit off(dice, material_of(dice));
        if (!off.ahead()) continue;
        mirror.take(length(off.mirrored() - direction_of(off, reflect(off.hit))), turn_reflected(off.known));
        mirrored_line.take(length(cross(off.apart(), off.mirrored())), side_reflected(off.known));
        // As in scatter().
        const bool in = dice.chance(.5);
        const double b = in ? 1 / off.material.ior : off.material.ior, s = -dot(off.hit.direction, off.hit.normal);
        const double k = fma(b * b, fma(s, s, -1.), 1.);
        const Vec3<double> beyond =
            fma(fma(b, s, -std::sqrt(std::max(k, 0.))), off.hit.normal, scale(b, off.hit.direction));
        const R ratio = in ? 1 / R(off.material.ior) : R(off.material.ior), c = -dot(off.direction, off.normal);
        const R exact_k = 1 - ratio * ratio * (1 - c * c);
        const double k_error = error_beyond(off.known, b, s);
        square.take(size(exact_k - k), k_error);
        if (!(std::abs(k) > k_error)) continue;
        total.demand((exact_k > 0) == (k > 0));
        if (!(k > 0) || !(exact_k > 0)) continue;
        const Vector exact = ratio * off.direction + (ratio * c - root(exact_k)) * off.normal;
        glass.take(length(exact - direction_of(off, beyond)), turn_refracted(off.known, b, s, k, k_error));
        refracted_line.take(length(cross(off.apart(), exact)), side_refracted(off.known, s, k, k_error));
    }
}

TEST_CASE("formulas of light") {
    Closest cosine{"cosine"}, highlight{"highlight"}, distance{"distance"}, way{"way to the light"},
        facing{"facing, or not"};
    Dice dice(5);
    for (int i = 0; i < trials(); ++i) {
        const OffHit off(dice, material_of(dice));
        const Hit<double>& hit = off.hit;
        // A light that was placed, and often one in the mirrored direction.
        const DVec3 home = dice.chance(.3) ? DVec3(0) : dice.vector(-1, 1) * std::pow(10, dice.in(-1, 4));
        const DVec3 aim = dice.chance(.5) ? rounded(off.mirrored() + R(any_size(dice, -1)) * Vector(dice.direction()))
                                          : dice.direction();
        const double away = std::pow(10, dice.in(-2, 3));
        const DVec3 file = home + DVec3(hit.position) + away * aim;
        LightKernel<double> light{};
        light.position = file - home, light.color = Vec3<double>(1);
        Vector exact_place = Vector(file) - Vector(home);
        if (dice.chance(.3)) {  // parallel light
            light.finite = 0, light.position = aim;
            exact_place = off.position + Vector(aim);
        }

        const Vec3<double> to_light = fma(-light.finite, hit.position, light.position);
        const double length_of_way = std::sqrt(dot(to_light, to_light)), inverse = 1 / length_of_way;
        const Vec3<double> l = scale(inverse, to_light), reflected = reflect(hit);
        const double c = dot(hit.normal, to_light) * inverse, own = highlight_of(hit, reflected, l, true);
        const LitBounds<double> lit = bound_lit(off.known, hit, light, length_of_way, c, dot(reflected, l), own);

        const Vector to = exact_place - off.position, exact_l = unit(to);
        const R exact_c = dot(off.normal, exact_l), shine = dot(off.mirrored(), exact_l);
        const R exact_highlight = shine > 0 ? R(off.material.specular) * power(shine, R(off.material.pow)) : R(0);
        distance.take(size(length(to) - length_of_way), lit.distance);
        if (!(lit.distance < .25 * length_of_way)) continue;
        if (off.ahead() == (dot(hit.direction, hit.normal) < 0))
            highlight.take(size(exact_highlight - own), lit.highlight);
        way.take(length(exact_l - unit(vector(l))), lit.ray.turn);
        cosine.take(size(exact_c - c), lit.cosine);
        if (!lit.doubt) facing.demand((exact_c > 0) == (c > 0));
    }
}

/// At the borders of their cones, wide and narrow ones.
TEST_CASE("formulas of spots") {
    Closest share{"what a spot sends"}, border{"at its border"};
    Dice dice(15);
    for (int i = 0; i < trials(); ++i) {
        const double place_size = std::pow(10, dice.in(-1, 4));
        Light light{.position = dice.vector(-1, 1) * place_size};
        Spot spot{light.position + dice.arrow(.1, 10)};
        spot.radius = dice.chance(.1) ? 90 : 90 * std::pow(10, dice.in(-6, 0));
        spot.falloff = std::min(90., dice.chance(.3) ? spot.radius : spot.radius * (1 + std::pow(10, dice.in(-8, 0))));
        if (dice.chance(.4)) spot.tightness = dice.chance(.5) ? dice.upto(100) : dice.in(0, 3);
        light.spot = spot;
        Scene scene;
        scene.lights = {light};
        ThreadPool pool(1);
        const BuiltWorld<double> built(scene, Placement{}, pool, nullptr);
        const SpotKernel<double>& kernel = built.world().lights[0].cone;
        const Vector axis = unit(Vector(spot.look_at) - Vector(light.position));
        const double degrees = dice.chance(.3) ? dice.in(0, 100) : dice.chance(.5) ? spot.falloff : spot.radius;
        const R angle = exact::radians<R>(degrees * (1 + any_size(dice) * dice.in(-1, 1)));
        const Vector across = perpendicular(dice, axis);
        const Vector way = R(-1) * (exact::cosine_of(angle) * axis + sine_of(angle) * across);
        const DVec3 l = nearly_unit(dice, way);
        const Vector exact_l = unit(vector(l) + R(any_size(dice)) * (dice.chance(.5) ? across : R(-1) * across));
        const double error = spot_error(kernel, l, turn_from(exact_l, l));
        const R wrong = size(exact::Tracer<R>::share_of_spot(light, exact_l) - spot_share(kernel, l));
        (error < .01 ? share : border).take(wrong, error);
    }
}

TEST_CASE("formulas of what is met first") {
    Closest first{"the nearest"}, missed{"nothing met"}, dark{"shadow"};
    Dice dice(6);
    for (int i = 0; i < trials(); ++i) {
        Candidates<double> found;
        LightBounds<double> light;
        light.dark = light.doubt = false;
        const double distance = dice.in(2, 8), off = any_size(dice, 0);
        const R exact_distance = R(distance) + R(dice.in(-1, 1)) * R(off);
        R nearest = inf;
        int surface = -1;
        bool between = false;
        for (int body = 0; body < 3; ++body) {
            const R t = dice.chance(.3)                   ? exact_distance + R(any_size(dice, -1) * dice.in(-1, 1))
                        : dice.chance(.3) && surface >= 0 ? nearest + R(any_size(dice, -1) * dice.in(-1, 1))
                                                          : R(dice.in(-4, 9));
            const double doubt = any_size(dice, 0), low = static_cast<double>(t) - doubt * dice.in(0, 1) - 1e-15;
            const double high = static_cast<double>(t) + doubt * dice.in(0, 1) + 1e-15;
            SpanBounds<double> span;
            span.sure = dice.chance(.6), span.maybe = true;
            const bool meets = span.sure || dice.chance(.5);
            if (high > 0) found.add(true, low, span.sure && low > 0 ? high : inf, 1., body, 0.);
            bool certain = false, possible = false;
            pass_crossing(low, high, span, true, distance, off, certain, possible);
            dark.demand(!certain || (meets && t > 0 && t < exact_distance));
            between |= meets && t > 0 && t < exact_distance;
            dark.demand(certain || possible || !(meets && t > 0 && t < exact_distance));
            if (meets && t > 0 && t < nearest) nearest = t, surface = body;
        }
        if (found.hits()) first.demand(surface == static_cast<int>(found.surface));
        if (found.misses()) missed.demand(surface < 0);
    }
}

TEST_CASE("formulas of boxes") {
    Closest met{"a box that is met"};
    Dice dice(7);
    for (int i = 0; i < trials(); ++i) {
        // The exact ray passes a corner or an edge of a box; what is in it may be off as well.
        const DVec3 low = dice.vector(-3, 3), high = low + dice.vector(.01, 1);
        Slack<double> slack;
        slack.reach = 4, slack.culled = any_size(dice);
        DVec3 place;
        for (int c = 0; c < 3; ++c)
            place[c] = dice.chance(.3) ? dice.in(low[c], high[c]) : dice.chance(.5) ? low[c] : high[c];
        Vector point(place);
        for (int c = 0; c < 3; ++c) {
            R& x = c == 0 ? point.x : c == 1 ? point.y : point.z;
            x = x + R(2 * slack.culled * slack.reach) * (dice.chance(.5) ? 1 : -1);
        }
        const double way = std::pow(10, dice.in(-1, .8));
        const Vector along = Vector(dice.direction()), origin = point - R(way) * along;
        DoubtfulRay<double> own{{rounded(origin + R(any_size(dice)) * Vector(dice.direction())),
                                 rounded(unit(along + R(any_size(dice)) * Vector(dice.direction()))), -1},
                                {}};
        const Vector exact = unit(along);
        own.doubt = {above(length(origin - vector(own.ray.origin))), above(length(exact - vector(own.ray.direction)))};
        double near;
        met.demand(crosses(Vec3<double>(low), Vec3<double>(high), traversal_ray(own, slack), inf, near));
    }
}
