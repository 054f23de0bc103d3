#include "scene/kinds/blob/blob.h"

#include <algorithm>
#include <span>
#include <utility>

#include "num/box_tree.h"
#include "num/vec_math.h"

namespace strahl {
namespace {

struct PlacedPiece {
    LumpPiece piece;
    Box box;
};

/// Orders pieces so that each group of them is near together: halves them along the longest side of their middles.
void group_pieces(std::span<PlacedPiece> all) {
    const std::size_t groups = (all.size() + BlobData::group - 1) / BlobData::group;
    if (groups < 2) return;
    const std::size_t half = groups / 2 * BlobData::group;
    halve(all, half, [](const PlacedPiece& own) { return own.box.centre(); });
    group_pieces(all.first(half)), group_pieces(all.subspan(half));
}

}  // namespace

BlobData::BlobData(std::vector<Lump> all) : lumps(std::move(all)) {
    const auto box_of = [](const Lump& own, const DVec3& from, const DVec3& to) {
        const glm::dmat3 m(own.x, own.y, own.z);
        Box around;
        for (const DVec3& end : {m * from, m * to})
            for (int i = 0; i < 3; ++i) {
                const double reach = own.radius * length(DVec3(own.x[i], own.y[i], own.z[i]));
                around.low[i] = std::min(around.low[i], end[i] - reach);
                around.high[i] = std::max(around.high[i], end[i] + reach);
            }
        return around;
    };
    for (const Lump& own : lumps)
        if (const Box around = box_of(own, own.from, own.to); own.strength > 0)
            box.add(around.low), box.add(around.high);
    if (box.empty()) return;
    const DVec3 size = box.size();
    centre = box.centre(), unit = std::max({size.x, size.y, size.z}) / 2;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    std::vector<PlacedPiece> placed;
    for (const Lump& own : lumps) {
        const glm::dmat3 m(own.x, own.y, own.z);
        const DVec3 line = own.to - own.from;
        const double far = length(line);
        const DVec3 along = far > 0 ? line / far : DVec3(0, 0, 1);
        const DVec3 beside = normalize(cross_product(std::abs(along.x) < .5 ? DVec3(1, 0, 0) : DVec3(0, 1, 0), along));
        const glm::dmat3 turned = glm::transpose(glm::dmat3(beside, cross_product(along, beside), along));
        const glm::dmat3 rows = glm::transpose(turned * glm::inverse(m) * (unit / own.radius));
        const DVec3 at = (m * own.from - centre) / unit;
        const auto add = [&](const DVec3& from, const DVec3& to, double round, double end, double low, double high) {
            placed.push_back(
                {{at, rows[0], rows[1], rows[2], round, end, low, high, own.strength}, box_of(own, from, to)});
        };
        const double end = far / own.radius;
        if (!(far > 0)) {
            add(own.from, own.from, 1, 0, -infinite, infinite);
            continue;
        }
        add(own.from, own.from, 1, 0, -infinite, 0);
        add(own.from, own.to, 0, 0, 0, end);
        add(own.to, own.to, 1, end, end, infinite);
    }
    group_pieces(placed);
    for (std::size_t i = 0; i < placed.size(); ++i) {
        pieces.push_back(placed[i].piece);
        if (i % group != 0) continue;
        Box around;
        for (std::size_t k = i; k < std::min(i + group, placed.size()); ++k)
            around.add(placed[k].box.low), around.add(placed[k].box.high);
        pieces.back().middle = (around.centre() - centre) / unit;
        pieces.back().square = dot_product(around.size(), around.size()) / (4 * unit * unit) * (1 + 1e-9);
    }
}

double BlobData::field(const DVec3& p) const {
    double sum = 0;
    DVec3 slope;
    for (const LumpPiece& piece : pieces) {
        const double share = piece.share((p - centre) / unit, slope);
        sum += piece.strength * share * share;
    }
    return sum;
}

std::shared_ptr<const BlobData> BlobData::usual() {
    static const auto shared = std::make_shared<const BlobData>(
        std::vector<Lump>{{{-.4, 0, 0}, {-.4, 0, 0}}, {{.5, .1, 0}, {.6, .2, .3}, .8}});
    return shared;
}

const char* Blob::fault() const {
    if (!(threshold > 0)) return "its threshold is not above 0";
    if (data->box.empty()) return "it has no lump that adds to its field";
    for (const LumpPiece& piece : data->pieces)
        for (const DVec3& v : {piece.centre, piece.row_x, piece.row_y, piece.row_z})
            if (!std::isfinite(dot_product(v, v))) return "one of its lumps is flat";
    return nullptr;
}

}  // namespace strahl
