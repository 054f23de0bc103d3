// Finds bodies declared twice in the same place.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "num/thread_pool.h"

namespace strahl {

/// Returns the items that have the same numbers as an earlier one, ascending: of bodies in the same place the first
/// declared is seen, and rays that start on it would meet its duplicate a rounding error before or behind. Item i is at
/// items[i * stride], and its first `size` numbers count.
///
/// Each item has a bit by its numbers, in a table that stays in the cache; only those that share one are compared.
template <class T>
std::vector<std::int32_t> duplicates(const T* items, std::int32_t count, std::size_t stride, std::size_t size,
                                     ThreadPool& pool) {
    const auto numbers = [=](std::int32_t i) { return std::span<const T>(items + i * stride, size); };
    const int unused_bits = std::countl_zero(64 + 32 * static_cast<std::uint32_t>(count));
    const auto slots = std::make_unique_for_overwrite<std::uint32_t[]>(count);
    share_out(pool, count, 8192, [&](std::int32_t first, std::int32_t last) {
        for (std::int32_t i = first; i < last; ++i) {
            std::uint64_t hash = 0;
            for (const T v : numbers(i)) {  // 0 is added because -0 equals it
                hash = (hash ^ std::bit_cast<std::uint64_t>(static_cast<double>(v) + 0.)) * 0x9E3779B97F4A7C15u;
                hash ^= hash >> 29;
            }
            slots[i] = static_cast<std::uint32_t>(hash * 0x9E3779B97F4A7C15u >> 32) >> unused_bits;
        }
    });
    std::vector<bool> taken(std::size_t(1) << (32 - unused_bits)), shared;
    for (std::int32_t i = 0; i < count; ++i) {
        if (taken[slots[i]]) {
            shared.resize(taken.size());
            shared[slots[i]] = true;
        }
        taken[slots[i]] = true;
    }
    std::vector<std::int32_t> result;
    if (shared.empty()) return result;
    std::vector<std::int32_t> suspects;
    for (std::int32_t i = 0; i < count; ++i)
        if (shared[slots[i]]) suspects.push_back(i);
    std::stable_sort(suspects.begin(), suspects.end(), [&](auto a, auto b) { return slots[a] < slots[b]; });
    std::vector<std::int32_t> kept;  // of one slot, all different
    for (const std::int32_t i : suspects) {
        if (!kept.empty() && slots[kept[0]] != slots[i]) kept.clear();
        if (std::any_of(kept.begin(), kept.end(),
                        [&](std::int32_t k) { return std::ranges::equal(numbers(k), numbers(i)); }))
            result.push_back(i);
        else
            kept.push_back(i);
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace strahl
