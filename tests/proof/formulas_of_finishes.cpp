// Error bounds of formulas of POV-Ray's finishes, against exact arithmetic.
#include "tests/proof/exact_finish.h"
#include "tests/proof/trial.h"
#include "trace/proof/finish_bounds_kernel.h"
#include "trace/proof/special_light_bounds.h"

using namespace strahl;
using namespace strahl::trial;
using exact::cosine_of, exact::radians;

namespace {

/// An angle, the cosine that is computed of it, and an angle that is off by `turn`.
struct OffAngle {
    R exact;
    double cosine, turn;
    explicit OffAngle(Dice& dice) {
        const R quarter = radians<R>(90);
        const R angle = dice.chance(.3) ? R(std::pow(10, dice.in(-12, 0))) : quarter * R(dice.in(0, 1));
        const R near = dice.chance(.2) ? quarter - angle : angle;
        turn = any_size(dice);
        exact = std::clamp(near + R(turn) * R(dice.in(-1, 1)), R(0), quarter);
        cosine = static_cast<double>(cosine_of(near)) * (1 + 6 * unit_error<double> * dice.in(-1, 1));
        cosine = std::clamp(cosine, 0., 1.);
    }
    Bounded<double> bounded() const { return {cosine, cosine_error(turn, cosine) + 8 * unit_error<double>}; }
};

/// Takes the error of a bounded number.
void take(Closest& closest, const Bounded<double>& found, R exact) {
    closest.take(size(R(found.value) - exact), found.off);
}

}  // namespace

TEST_CASE("formulas of finishes: powers, metals, Fresnel's law and lights that fade") {
    Dice dice(7);
    Closest powers{"powers of cosines"}, metals{"tints of metals"}, mirrors{"Fresnel's law"}, fades{"fading lights"};
    Closest sums{"sums, products and roots"};
    for (int i = 0; i < trials(); ++i) {
        const OffAngle angle(dice);
        const R c = cosine_of(angle.exact);
        const double p = std::pow(10, dice.in(-.5, 3));
        take(powers, power_bounds(angle.bounded(), p), power(c, R(p)));

        Material m;
        m.metallic = m.gilding = dice.in(0, 1.5), m.reflection = 1;
        const double own = dice.in(0, 1.2);
        const exact::Finish<R> metal(m, Vector(own, own, own));
        const auto tint = tint_bounds(Bounded<double>{own}, m.metallic, metal_bounds(angle.cosine, angle.turn));
        take(metals, tint, metal.reflected(c, true, 0).color.x);

        m.gilding = 0, m.fresnel = 1, m.facing = 0,
        m.ior = dice.chance(.2) ? 1 + std::pow(10, dice.in(-6, 0)) : dice.in(1, 3);
        const bool enters = dice.chance(.6);
        const exact::Finish<R> glass(m, Vector(1, 1, 1));
        const auto share = fresnel_bounds(enters ? m.ior : 1 / m.ior, angle.bounded());
        take(mirrors, share, glass.reflected(c, enters, 0).color.x);

        LightKernel<double> light;
        light.fade_per = std::pow(10, dice.in(-3, 3)), light.fade_power = dice.chance(.4) ? 2 : dice.in(.2, 6);
        const double distance = std::pow(10, dice.in(-3, 3)), off = distance * any_size(dice, -2);
        const R way = (R(distance) + R(off) * R(dice.in(-1, 1))) * R(light.fade_per);
        const double strength = faded_share(light, distance);
        take(fades, {strength, fading_error(light, strength, distance, off)},
             2 / (1 + power(way, R(light.fade_power))));

        const Bounded<double> a{dice.in(.1, 2), any_size(dice)}, b{dice.in(.1, 2), any_size(dice)};
        const R exact_a = R(a.value) + R(a.off) * R(dice.in(-1, 1)),
                exact_b = R(b.value) + R(b.off) * R(dice.in(-1, 1));
        take(sums, root(a * b + a) / (a + b) - b, root(exact_a * exact_b + exact_a) / (exact_a + exact_b) - exact_b);
    }
}
