// A ball with bumps, of about N triangles that share their corners: bench_growth N > FILE.ply
//
// Rings of as many corners as there are rings; radius 1 + .08 sin(7 x) sin(9 y) sin(8 z) of the unit direction.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <vector>

int main(int argc, char** argv) {
    const double wanted = argc == 2 ? std::atof(argv[1]) : 0;
    const int rings = static_cast<int>(std::lround(std::sqrt(wanted / 2))), inner = rings - 1;
    if (rings < 3) return std::fputs("bench_growth N > FILE.ply, N from 18\n", stderr), 2;
    std::vector<float> points;
    const auto add = [&](double height, double angle) {
        const double across = std::sqrt(std::max(0., 1 - height * height));
        const double x = across * std::cos(angle), y = across * std::sin(angle), z = height;
        const double r = 1 + .08 * std::sin(7 * x) * std::sin(9 * y) * std::sin(8 * z);
        for (const double v : {r * x, r * y, r * z}) points.push_back(static_cast<float>(v));
    };
    add(-1, 0);
    for (int i = 1; i < rings; ++i)
        for (int k = 0; k < rings; ++k)
            add(-std::cos(i * std::numbers::pi / rings), (k + .5 * i) * 2 * std::numbers::pi / rings);
    add(1, 0);
    const std::int32_t last = 1 + inner * rings;
    const auto at = [&](int i, int k) { return i == 0 ? 0 : i == rings ? last : 1 + (i - 1) * rings + k % rings; };
    std::printf(
        "ply\nformat binary_little_endian 1.0\nelement vertex %zu\nproperty float x\nproperty float y\n"
        "property float z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n",
        points.size() / 3, 2 * inner * rings);
    std::fwrite(points.data(), sizeof(float), points.size(), stdout);
    const auto face = [](std::int32_t a, std::int32_t b, std::int32_t c) {
        std::putchar(3);
        const std::int32_t corners[]{a, b, c};
        std::fwrite(corners, sizeof(std::int32_t), 3, stdout);
    };
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < rings; ++k) {
            if (i > 0) face(at(i, k), at(i, k + 1), at(i + 1, k));
            if (i < inner) face(at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
        }
}
