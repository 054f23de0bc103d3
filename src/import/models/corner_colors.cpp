#include "import/models/corner_colors.h"

#include <algorithm>

#include "import/models/model.h"
#include "num/bounding_box.h"
#include "scene/error.h"

namespace strahl {
namespace {

/// Spreads the lowest 20 bits, so that each is followed by two 0s.
std::uint64_t spread(std::uint64_t bits) {
    bits = (bits | bits << 32) & 0x1F00000000FFFF;
    bits = (bits | bits << 16) & 0x1F0000FF0000FF;
    bits = (bits | bits << 8) & 0x100F00F00F00F00F;
    bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
    return (bits | bits << 2) & 0x1249249249249249;
}
/// Takes every second bit together again.
std::uint32_t gathered(std::uint32_t bits) {
    bits &= 0x55555555;
    bits = (bits | bits >> 1) & 0x33333333;
    bits = (bits | bits >> 2) & 0x0F0F0F0F;
    bits = (bits | bits >> 4) & 0x00FF00FF;
    return (bits | bits >> 8) & 0x0000FFFF;
}

/// Returns the triangles in the order of a curve through space (G. M. Morton, "A Computer Oriented Geodetic Data Base
/// and a New Technique in File Sequencing", 1966).
std::vector<std::uint32_t> ordered(const MeshData& mesh) {
    Box box;
    for (const DVec3& p : mesh.points) box.add(p);
    const double size = std::max({box.size().x, box.size().y, box.size().z, 1e-300});
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(mesh.triangles.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const auto [a, b, c] = mesh.triangles[i];
        const DVec3 sum = (mesh.points[a] - box.low) + (mesh.points[b] - box.low) + (mesh.points[c] - box.low);
        std::uint64_t key = 0;
        for (int axis = 0; axis < 3; ++axis)
            key |= spread(static_cast<std::uint64_t>(sum[axis] / size / 3 * ((1 << 20) - 1))) << axis;
        keys[i] = {key, static_cast<std::uint32_t>(i)};
    }
    std::ranges::sort(keys);
    std::vector<std::uint32_t> order(keys.size());
    std::ranges::transform(keys, order.begin(), [](const auto& key) { return key.second; });
    return order;
}

}  // namespace

Pigment color_corners(MeshData& mesh, const CornerColors& given) {
    const std::size_t count = mesh.triangles.size();
    // Blocks have a border of one pixel around the cell that is the triangle's, where memory allows.
    constexpr std::size_t most_bordered = 500'000, most_side = 1 << 15;
    const bool bordered = !given.by_triangle && count <= most_bordered;
    const std::int32_t block = given.by_triangle ? 1 : bordered ? 4 : 2, border = bordered ? 1 : 0;
    std::size_t side = 1;
    while (side * side < count) side *= 2;
    if (side * std::size_t(block) > most_side)
        throw FileError("colours of more than " + std::to_string(most_side / 2 * (most_side / 2)) +
                        " triangles; simplify the mesh, or split it");
    // Bilinear colours are linear light, and so those between which they lie are.
    std::vector<Color> colors(given.colors.size());
    std::ranges::transform(given.colors, colors.begin(), [&](const MeshLook::Rgb& own) {
        const Color color(own[0], own[1], own[2]);
        return given.linear ? color : linear_light(color);
    });
    const std::vector<std::uint32_t> order = ordered(mesh);
    auto pixels = std::make_shared<Pixels>();
    pixels->linear = true;
    pixels->width = pixels->height = static_cast<std::int32_t>(side) * block;
    pixels->values.resize(3 * std::size_t(pixels->width) * std::size_t(pixels->height));
    const double size = pixels->width;
    mesh.places.resize((given.by_triangle ? 1 : 3) * count), mesh.corner_places.resize(count);
    const auto put = [&](std::size_t column, std::size_t row, int c, double value) {
        pixels->values[3 * (row * std::size_t(pixels->width) + column) + std::size_t(c)] = static_cast<float>(value);
    };
    for (std::size_t n = 0; n < count; ++n) {
        const std::uint32_t i = order[n], code = static_cast<std::uint32_t>(n);
        const std::size_t column = gathered(code) * std::size_t(block), row = gathered(code >> 1) * std::size_t(block);
        const auto color = [&](int k, int c) {
            const std::size_t number = given.by_triangle ? i : std::size_t(mesh.triangles[i][std::size_t(k)]);
            return colors[number][c];
        };
        for (int c = 0; c < 3; ++c) {
            for (int k = 0; k < 3; ++k) pixels->largest[c] = std::max(pixels->largest[c], color(k, c));
            // Beyond the triangle colours go on linearly, below 0 where need be: no point of the body has them.
            for (int y = 0; y < block; ++y)
                for (int x = 0; x < block; ++x) {
                    const double u = x - border, v = y - border;
                    put(column + std::size_t(x), row + std::size_t(y), c,
                        given.by_triangle
                            ? color(0, c)
                            : color(0, c) + u * (color(1, c) - color(0, c)) + v * (color(2, c) - color(0, c)));
                }
        }
        // The middle of a pixel is at .5; v goes up.
        const auto place = [&](int x, int y) {
            return MeshData::Place{(double(column) + border + x + .5) / size,
                                   1 - (double(row) + border + y + .5) / size};
        };
        const auto first = static_cast<std::int32_t>((given.by_triangle ? 1 : 3) * n);
        mesh.places[std::size_t(first)] = place(0, 0);
        if (given.by_triangle) {
            mesh.corner_places[i] = {first, first, first};
        } else {
            mesh.places[std::size_t(first) + 1] = place(1, 0), mesh.places[std::size_t(first) + 2] = place(0, 1);
            mesh.corner_places[i] = {first, first + 1, first + 2};
        }
    }
    return Pigment(
        Pattern{.kind = ImagePattern{.file = "", .pixels = std::move(pixels), .once = {}, .sharp = given.by_triangle},
                .colors = {},
                .transformations = {},
                .by_uv = true});
}

}  // namespace strahl
