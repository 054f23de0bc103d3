// Holds what mesh files say besides triangles: colours, and the groups and materials that triangles belong to.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace strahl {

struct MeshLook {
    using Rgb = std::array<float, 3>;  // as the file gives it, 1 being full; sRGB-encoded by custom
    /// Triangles from `first` on, up to the next run.
    struct NamedRun {
        std::size_t first = 0;
        std::int32_t name = -1, material = -1;  // indices of `names` and `materials`; -1: none
        bool operator==(const NamedRun&) const = default;
    };
    std::vector<Rgb> point_colors;                         // one for each point, or none at all
    std::vector<Rgb> triangle_colors;                      // one for each triangle, or none at all
    std::vector<NamedRun> runs;                            // of OBJ files, ascending; none if nothing is named
    std::vector<std::string> names, materials, libraries;  // of objects and groups, `usemtl`, and `mtllib` lines

    /// A colour that is given as a whole number from 0 to `most` or, if `most` is 0, as a share.
    static float share(double value, double most) {
        const double share = most > 0 ? value / most : value;
        return share > 0 ? share < 1 ? static_cast<float>(share) : 1 : 0;  // NaN is 0
    }
};

}  // namespace strahl
