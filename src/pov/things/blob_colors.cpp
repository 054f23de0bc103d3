#include "pov/things/blob_colors.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

#include "num/box_tree.h"
#include "num/vec_math.h"

namespace strahl::pov {
namespace {

/// A lump and its colour.
struct ColoredLump {
    Lump lump;
    glm::dmat3 inverse;
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

bool holds(const Box& box, const DVec3& p) {
    return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x <= box.high.x && p.y <= box.high.y &&
           p.z <= box.high.z;
}

struct BlobColors : FunctionThing {
    BlobColors(std::vector<ColoredLump> all, std::vector<Box> boxes, double least)
        : lumps(std::move(all)), tree(std::move(boxes)), least(least) {
        results = 5;
    }
    void evaluate(const double* given, double* result) const override {
        const DVec3 p(given[0], given[1], given[2]);
        double sum = 0;
        std::vector<std::pair<const FunctionThing*, double>> weights;
        tree.visit([&](const Box& box) { return holds(box, p); },
                   [&](std::size_t i) {
                       const double weight = lumps[i].field(p);
                       if (!(weight > 0)) return;
                       sum += weight;
                       const FunctionThing* const color = lumps[i].color.get();
                       const auto known = std::ranges::find(weights, color, [](const auto& own) { return own.first; });
                       if (known != weights.end())
                           known->second += weight;
                       else
                           weights.emplace_back(color, weight);
                   });
        std::fill_n(result, 5, 0.);
        for (const auto& [color, weight] : weights) {
            if (weight / sum < least) continue;
            double own[5];
            color->evaluate(given, own);
            for (int c = 0; c < 5; ++c) result[c] += weight / sum * own[c];
        }
    }
    std::vector<ColoredLump> lumps;
    BoxTree tree;
    double least;
};

}  // namespace

std::shared_ptr<const FunctionThing> blob_colors(const std::vector<Lump>& lumps,
                                                 const std::vector<std::shared_ptr<const FunctionThing>>& colors,
                                                 double least) {
    std::vector<ColoredLump> all;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < lumps.size(); ++i) {
        const Lump& own = lumps[i];
        const glm::dmat3 m(own.x, own.y, own.z);
        Box box;
        for (const DVec3& end : {m * own.from, m * own.to})
            for (int c = 0; c < 3; ++c) {
                const double reach = own.radius * length(DVec3(m[0][c], m[1][c], m[2][c]));
                box.low[c] = std::min(box.low[c], end[c] - reach), box.high[c] = std::max(box.high[c], end[c] + reach);
            }
        all.push_back({own, glm::inverse(m), colors[i]}), boxes.push_back(box);
    }
    return std::make_shared<BlobColors>(std::move(all), std::move(boxes), least);
}

}  // namespace strahl::pov
