// Finds bodies declared twice in the same place.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "num/thread_pool.h"

namespace strahl {

/// Returns the items that have the same numbers as an earlier one, ascending: of bodies in the same place the first
/// declared is seen, and rays that start on it would meet its duplicate a rounding error before or behind. Item i is at
/// items[i * stride], and its first `size` numbers count.
///
/// Items are shared out to parts by their numbers. Each has a bit in the table of its part, which stays in the cache;
/// only those that share one are compared.
template <class T>
std::vector<std::int32_t> duplicates(const T* items, std::int32_t count, std::size_t stride, std::size_t size,
                                     ThreadPool& pool) {
    using Hashed = std::uint64_t;  // an item, and above it 32 bits of its numbers
    const auto numbers = [=](Hashed i) {
        return std::span<const T>(items + static_cast<std::uint32_t>(i) * stride, size);
    };
    const std::int32_t parts = 1 << std::max<int>(0, std::bit_width(static_cast<std::uint32_t>(count)) - 15);
    const std::int32_t pieces = 2 * pool.size(), step = count / pieces + 1;
    const int unused_bits = std::countl_zero(64 + 32 * static_cast<Hashed>(count / parts));
    std::vector<std::vector<std::vector<Hashed>>> hashed(pieces);
    share_out(pool, count, step, [&](std::int32_t first, std::int32_t last) {
        auto& own = hashed[first / step];
        own.resize(parts);
        for (auto& part : own) part.reserve((last - first) / parts * 9 / 8 + 64);
        for (std::int32_t i = first; i < last; ++i) {
            constexpr std::uint64_t factor = 0x9E3779B97F4A7C15u;
            std::uint64_t hash = 0;
            for (const T v : numbers(i)) {  // adding 0 makes -0 and 0, which are equal, the same bits
                hash = (hash ^ std::bit_cast<std::uint64_t>(static_cast<double>(v) + 0.)) * factor;
                hash ^= hash >> 29;
            }
            hash *= factor;
            own[(hash >> 32) % parts].push_back(hash >> 32 << 32 | i);
        }
    });
    std::vector<std::int32_t> result;
    std::mutex growing;
    share_out(pool, count > 1 ? parts : 0, 1, [&](std::int32_t part, std::int32_t) {
        std::vector<bool> taken(std::size_t(1) << (64 - unused_bits)), shared;
        const auto each = [&](const auto& act) {
            for (const auto& piece : hashed)
                if (!piece.empty()) std::for_each(piece[part].begin(), piece[part].end(), act);
        };
        each([&](Hashed item) {
            const std::size_t slot = item >> unused_bits;
            if (taken[slot]) {
                shared.resize(taken.size());
                shared[slot] = true;
            }
            taken[slot] = true;
        });
        if (shared.empty()) return;
        std::vector<Hashed> suspects;
        each([&](Hashed item) {
            if (shared[item >> unused_bits]) suspects.push_back(item);
        });
        std::sort(suspects.begin(), suspects.end());
        std::vector<Hashed> kept;  // items with the same hash and different numbers
        for (const Hashed item : suspects) {
            if (!kept.empty() && kept[0] >> 32 != item >> 32) kept.clear();
            if (std::none_of(kept.begin(), kept.end(),
                             [&](Hashed k) { return std::ranges::equal(numbers(k), numbers(item)); })) {
                kept.push_back(item);
                continue;
            }
            const std::lock_guard lock(growing);
            result.push_back(static_cast<std::int32_t>(item));
        }
    });
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace strahl
