#include "trace/cells/layer_tile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trace/kernel/kernel.h"

namespace strahl {
namespace {

using Rows = LayerRows<float>;

int length_of(const Layers& layers, int lights) {
    if (layers.light) return Rows::lights + 3 * lights;
    return layers.geometry() ? Rows::own : Rows::distance;
}

void add_share(std::vector<std::pair<float, double>>& shares, float id, double weight) {
    const auto known = std::ranges::find(shares, id, &std::pair<float, double>::first);
    if (known != shares.end())
        known->second += weight;
    else
        shares.emplace_back(id, weight);
}

/// Writes ids and their shares, the largest first.
void put_ranks(std::vector<std::pair<float, double>> shares, double weight, std::vector<float>& to) {
    std::ranges::stable_sort(shares, std::greater<>(), &std::pair<float, double>::second);
    shares.resize(id_ranks);
    for (const auto& [id, share] : shares) to.push_back(id), to.push_back(static_cast<float>(share / weight));
}

}  // namespace

LayerTile::LayerTile(const Layers& own_layers, std::shared_ptr<const LayerTables> own_tables)
    : wanted(own_layers),
      known(std::move(own_tables)),
      row_length(length_of(wanted, static_cast<int>(known->lights.size()))),
      lights(known->lights.empty() ? 0 : known->lights.back() + 1) {}

void LayerTile::begin(int count) {
    rows.clear();
    pixels.assign(count, {});
    sums.assign(std::size_t(count) * row_length, 0);
}

float* LayerTile::add_sample() {
    rows.resize(rows.size() + row_length);
    return &rows[rows.size() - row_length];
}

void LayerTile::average(int number, int sample, double weight, const std::array<double, 3>& light) {
    const float* const row = &rows[std::size_t(sample) * row_length];
    double* const sum = &sums[std::size_t(number) * row_length];
    LayerPixel& pixel = pixels[number];
    pixel.weight += weight, sum[Rows::clear] += weight * double(row[Rows::clear]);
    for (int i = Rows::own; i < row_length; ++i) {
        const int at = i - Rows::lights, to = at < 0 ? i : Rows::lights + 3 * known->lights[at / 3] + at % 3;
        sum[to] += light[(i - Rows::own) % 3] * double(row[i]);
    }
    if (row_length <= Rows::distance || row[Rows::surface] < 0) return;
    pixel.covered += weight;
    for (int i = Rows::distance; i < Rows::surface; ++i) sum[i] += weight * double(row[i]);
    const auto id_of = [](const std::vector<float>& ids, std::int32_t i) { return ids[static_cast<std::size_t>(i)]; };
    if (wanted.body)
        add_share(pixel.bodies, id_of(wanted.ids->bodies, known->bodies[static_cast<std::size_t>(row[Rows::surface])]),
                  weight);
    if (wanted.material)
        add_share(pixel.materials,
                  id_of(wanted.ids->materials, known->materials[static_cast<std::size_t>(row[Rows::material])]),
                  weight);
}

template <class T>
std::vector<float> LayerTile::values(std::span<const T> rgb) const {
    std::vector<float> all;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const double* const sum = &sums[i * static_cast<std::size_t>(row_length)];
        const LayerPixel& pixel = pixels[i];
        const auto put = [&](int first, int count, double weight) {
            for (int c = first; c < first + count; ++c) all.push_back(static_cast<float>(sum[c] / weight));
        };
        // Distances, positions and normals are averaged over the part of the pixel that shows a body.
        const double covered = pixel.covered > 0 ? pixel.covered : 1;
        const std::size_t start = all.size();
        for (int c = 0; c < 3; ++c) all.push_back(static_cast<float>(rgb[3 * i + static_cast<std::size_t>(c)]));
        if (wanted.alpha) all.push_back(static_cast<float>(std::clamp(1 - sum[Rows::clear] / pixel.weight, 0., 1.)));
        if (wanted.depth && pixel.covered > 0) put(Rows::distance, 1, covered);
        if (wanted.depth && pixel.covered == 0) all.push_back(std::numeric_limits<float>::infinity());
        if (wanted.normal) put(Rows::normal, 3, covered);
        if (wanted.position) put(Rows::position, 3, covered);
        if (wanted.body) put_ranks(pixel.bodies, pixel.weight, all);
        if (wanted.material) put_ranks(pixel.materials, pixel.weight, all);
        if (!wanted.light) continue;
        const std::size_t light = all.size();
        put(Rows::own, 3, pixel.weight);
        put(Rows::lights, 3 * lights, pixel.weight);
        put(Rows::reflected, 6, pixel.weight);
        for (std::size_t c = 0; c < 3; ++c) {
            float sum_of_layers = all[light + c];
            for (std::size_t at = light + 3 + c; at < all.size(); at += 3) sum_of_layers += all[at];
            all[start + c] = sum_of_layers;
        }
    }
    return all;
}
template std::vector<float> LayerTile::values(std::span<const float>) const;
template std::vector<float> LayerTile::values(std::span<const double>) const;

}  // namespace strahl
