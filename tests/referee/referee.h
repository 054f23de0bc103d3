// The referee: the simplest possible Whitted ray tracer, with which all pictures of the tracer are compared.
//
// It shares no code with the tracer: it takes the plain values of a Scene and computes one point of the picture at a
// time, by recursion, with intersection formulas of its own. R is long double, or Quadruple for tiny pictures.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

#include "scene/scene.h"
#include "tests/referee/quadruple.h"

namespace strahl {

/// The value of one point, and a hash of every decision on the way (which faces were hit, which lights
/// reached the point through which bodies, where a ray was reflected totally or missed). Two samples with different
/// signatures have an edge between them.
struct Sample {
    std::array<long double, 3> rgb{};
    std::uint64_t signature = 0;
};

/// Rules by which POV-Ray decides otherwise. The defaults are Strahl's.
struct OtherRules {
    double nearest = 0;          // hits nearer to the start of a ray do not count
    double farthest = HUGE_VAL;  // hits farther away do not count
    double shadow = 0;       // casters nearer to either end of a shadow ray, or to the caster before them, do not count
    bool bent_side = false;  // a bent normal alone decides on which side of a surface a light is
    bool one_share = false;  // all parts of a composite reflect the share of its medium totally
    bool straight_is_free = false;  // a ray that passes a surface unrefracted does not count as a generation
};

template <class R>
class Referee {
  public:
    /// The scene is copied; `camera`, `width`, `height` and `depth` (generations, the primary ray being 1) as in a
    /// View.
    Referee(const Scene& scene, const Camera& camera, int width, int height, int depth, const OtherRules& rules = {});
    ~Referee();

    /// The sample at the picture point (x, y) in pixels; the centre of pixel (i, j) is (i + 1/2, j + 1/2).
    Sample at(double x, double y) const;

    /// Could a shift by `reach` pixels explain `rgb` at the centre of pixel (i, j)? True if one of 8 neighbours
    /// that far away has another signature, or if their spread plus `tolerance` covers the difference.
    bool explains(int i, int j, const double* rgb, double tolerance, double reach) const;

  private:
    struct World;
    std::unique_ptr<const World> world;
};

extern template class Referee<long double>;
#if LDBL_MANT_DIG < 113
extern template class Referee<Quadruple>;
#endif

}  // namespace strahl
