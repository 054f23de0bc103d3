#include "pov/things/blob_colors.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <span>
#include <utility>

#include "num/box_tree.h"
#include "num/vec_math.h"

namespace strahl::pov {
namespace {

constexpr std::size_t group = 16;

/// A lump, and the box around it.
struct ColoredLump {
    Lump lump;
    glm::dmat3 inverse;
    Box box;
    std::shared_ptr<const FunctionThing> color;

    double field(const DVec3& p) const {
        const DVec3 own = inverse * p - lump.from, line = lump.to - lump.from;
        const double square = dot_product(line, line);
        const double along = square > 0 ? std::clamp(dot_product(own, line) / square, 0., 1.) : 0;
        const DVec3 away = own - along * line;
        const double share = 1 - dot_product(away, away) / (lump.radius * lump.radius);
        return share > 0 ? std::fabs(lump.strength) * share * share : 0;
    }
};

/// Orders lumps so that those of each group are near together.
void group_lumps(std::span<ColoredLump> all) {
    const std::size_t groups = (all.size() + group - 1) / group;
    if (groups < 2) return;
    const std::size_t half = groups / 2 * group;
    halve(all, half, [](const ColoredLump& own) { return own.box.centre(); });
    group_lumps(all.first(half)), group_lumps(all.subspan(half));
}

bool holds(const Box& box, const DVec3& p) {
    return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x <= box.high.x && p.y <= box.high.y &&
           p.z <= box.high.z;
}

struct BlobColors : FunctionThing {
    BlobColors(std::vector<ColoredLump> all, double least) : lumps(std::move(all)), least(least) {
        results = 5;
        group_lumps(lumps);
        for (std::size_t i = 0; i < lumps.size(); ++i) {
            if (i % group == 0) boxes.emplace_back();
            boxes.back().add(lumps[i].box);
        }
    }
    void evaluate(const double* given, double* result) const override {
        const DVec3 p(given[0], given[1], given[2]);
        double sum = 0;
        std::vector<std::pair<const FunctionThing*, double>> weights;
        for (std::size_t n = 0; n < boxes.size(); ++n) {
            if (!holds(boxes[n], p)) continue;
            for (std::size_t i = n * group; i < std::min((n + 1) * group, lumps.size()); ++i) {
                const double weight = holds(lumps[i].box, p) ? lumps[i].field(p) : 0;
                if (!(weight > 0)) continue;
                sum += weight;
                const FunctionThing* const color = lumps[i].color.get();
                const auto known = std::ranges::find(weights, color, [](const auto& own) { return own.first; });
                if (known != weights.end())
                    known->second += weight;
                else
                    weights.emplace_back(color, weight);
            }
        }
        std::fill_n(result, 5, 0.);
        for (const auto& [color, weight] : weights) {
            if (weight / sum < least) continue;
            double own[5];
            color->evaluate(given, own);
            for (int c = 0; c < 5; ++c) result[c] += weight / sum * own[c];
        }
    }
    std::vector<ColoredLump> lumps;
    double least;
    std::vector<Box> boxes;  // around the lumps of each group
};

}  // namespace

std::shared_ptr<const FunctionThing> blob_colors(const std::vector<Lump>& lumps,
                                                 const std::vector<std::shared_ptr<const FunctionThing>>& colors,
                                                 double least) {
    std::vector<ColoredLump> all;
    for (std::size_t i = 0; i < lumps.size(); ++i) {
        const Lump& own = lumps[i];
        const glm::dmat3 m(own.x, own.y, own.z);
        Box box;
        for (const DVec3& end : {m * own.from, m * own.to})
            for (int c = 0; c < 3; ++c) {
                const double reach = own.radius * length(DVec3(m[0][c], m[1][c], m[2][c]));
                box.low[c] = std::min(box.low[c], end[c] - reach), box.high[c] = std::max(box.high[c], end[c] + reach);
            }
        all.push_back({own, glm::inverse(m), box, colors[i]});
    }
    return std::make_shared<BlobColors>(std::move(all), least);
}

}  // namespace strahl::pov
