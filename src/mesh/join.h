// Joins points of equal coordinates.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include "num/vec.h"

namespace strahl {

/// Numbers points in the order in which they come; equal ones get the same number. -0 equals 0.
class PointJoiner {
  public:
    PointJoiner() : PointJoiner(0) {}
    /// Makes room for so many points, which may become more.
    explicit PointJoiner(std::size_t expected) : slots(std::bit_ceil(2 * expected + 64), empty) {}

    std::int32_t number_of(DVec3 point) {
        point += 0.;  // -0 becomes 0
        if (2 * joined.size() >= slots.size()) grow();
        std::int32_t& slot = slot_of(point);
        if (slot == empty) {
            slot = static_cast<std::int32_t>(joined.size());
            joined.push_back(point);
        }
        return slot;
    }
    std::vector<DVec3>& points() { return joined; }

  private:
    static constexpr std::int32_t empty = -1;

    /// A hash with secrets, so that no file can give points that all fall into one slot, which would take for ever.
    static std::uint64_t hash(const DVec3& p) {
        static const auto secrets = [] {
            std::random_device random;
            std::array<std::uint64_t, 4> drawn;
            for (std::uint64_t& secret : drawn) secret = std::uint64_t(random()) << 32 | random();
            return drawn;
        }();
        using Wide = unsigned __int128;
        const auto fold = [](Wide product) {
            return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
        };
        const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
        const std::uint64_t plane = fold(Wide(bits(p.x) ^ secrets[0]) * (bits(p.y) ^ secrets[1]));
        return fold(Wide(plane ^ secrets[2]) * (bits(p.z) ^ secrets[3]));
    }
    std::int32_t& slot_of(const DVec3& point) {
        const std::size_t mask = slots.size() - 1;
        std::size_t at = hash(point) & mask;
        while (slots[at] != empty && joined[slots[at]] != point) at = (at + 1) & mask;
        return slots[at];
    }
    void grow() {
        slots.assign(4 * slots.size(), empty);
        for (std::size_t i = 0; i < joined.size(); ++i) slot_of(joined[i]) = static_cast<std::int32_t>(i);
    }

    std::vector<std::int32_t> slots;  // numbers of points; a power of two of them
    std::vector<DVec3> joined;
};

}  // namespace strahl
