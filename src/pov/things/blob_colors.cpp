#include "pov/things/blob_colors.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

#include "num/box_tree.h"
#include "num/vec_math.h"

namespace strahl::pov {
namespace {

bool holds(const Box& box, const DVec3& p) {
    return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x <= box.high.x && p.y <= box.high.y &&
           p.z <= box.high.z;
}

}  // namespace

struct BlobBlend::Fields {
    /// A lump and the number of its texture.
    struct TexturedLump {
        Lump lump;
        glm::dmat3 inverse;
        std::size_t texture;

        double field(const DVec3& p) const {
            const DVec3 own = inverse * p - lump.from, line = lump.to - lump.from;
            const double square = dot_product(line, line);
            const double along = square > 0 ? std::clamp(dot_product(own, line) / square, 0., 1.) : 0;
            const DVec3 away = own - along * line;
            const double share = 1 - dot_product(away, away) / (lump.radius * lump.radius);
            return share > 0 ? std::fabs(lump.strength) * share * share : 0;
        }
    };

    Fields(std::vector<TexturedLump> all, std::vector<Box> boxes, double fewest)
        : lumps(std::move(all)), tree(std::move(boxes)), least(fewest) {}

    /// Calls use(texture, share) for the textures at a point.
    template <class Use>
    void each_share(const double* given, const Use& use) const {
        const DVec3 p(given[0], given[1], given[2]);
        double sum = 0;
        std::vector<std::pair<std::size_t, double>> weights;
        tree.visit([&](const Box& box) { return holds(box, p); },
                   [&](std::size_t i) {
                       const double weight = lumps[i].field(p);
                       if (!(weight > 0)) return;
                       sum += weight;
                       const std::size_t texture = lumps[i].texture;
                       const auto known =
                           std::ranges::find(weights, texture, [](const auto& own) { return own.first; });
                       if (known != weights.end())
                           known->second += weight;
                       else
                           weights.emplace_back(texture, weight);
                   });
        for (const auto& [texture, weight] : weights)
            if (weight / sum >= least) use(texture, weight / sum);
    }
    std::vector<TexturedLump> lumps;
    BoxTree tree;
    double least;
};

struct BlobBlend::Colors : FunctionThing {
    Colors(std::shared_ptr<const Fields> all, std::vector<std::shared_ptr<const FunctionThing>> of_textures)
        : fields(std::move(all)), colors(std::move(of_textures)) {
        results = 5;
        some = std::ranges::any_of(colors, [](const auto& color) { return !color; });
    }
    void evaluate(const double* given, double* result) const override {
        double sum = 0;
        std::fill_n(result, 5, 0.);
        fields->each_share(given, [&](std::size_t texture, double share) {
            if (!colors[texture]) return;
            double own[5];
            colors[texture]->evaluate(given, own);
            for (int c = 0; c < 5; ++c) result[c] += share * own[c];
            sum += share;
        });
        for (int c = 0; c < 5 && some && sum > 0; ++c) result[c] /= sum;
    }
    std::shared_ptr<const Fields> fields;
    std::vector<std::shared_ptr<const FunctionThing>> colors;
    bool some;  // do some parts have no colour of their own?
};

struct BlobBlend::Share : FunctionThing {
    Share(std::shared_ptr<const Fields> all, std::vector<char> which)
        : fields(std::move(all)), counted(std::move(which)) {
        results = 5;
    }
    void evaluate(const double* given, double* result) const override {
        std::fill_n(result, 5, 0.);
        fields->each_share(given, [&](std::size_t texture, double share) {
            if (counted[texture]) result[0] += share;
        });
        result[1] = result[2] = result[0];
    }
    std::shared_ptr<const Fields> fields;
    std::vector<char> counted;
};

BlobBlend::BlobBlend(const std::vector<Lump>& lumps, std::vector<std::size_t> textures, double least) {
    std::vector<Fields::TexturedLump> all;
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
        all.push_back({own, glm::inverse(m), textures[i]}), boxes.push_back(box);
    }
    fields = std::make_shared<Fields>(std::move(all), std::move(boxes), least);
}

std::shared_ptr<const FunctionThing> BlobBlend::colors(std::vector<std::shared_ptr<const FunctionThing>> own) const {
    return std::make_shared<Colors>(fields, std::move(own));
}

std::shared_ptr<const FunctionThing> BlobBlend::share(std::vector<char> counted) const {
    return std::make_shared<Share>(fields, std::move(counted));
}

}  // namespace strahl::pov
