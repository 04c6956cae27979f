// Levels of a step as bytes, and back.
#include "index/file/sections/step_levels.h"

#include "index/file/sections/file_layout.h"

#include <algorithm>
#include <cstring>

namespace isochron::index {
namespace {

/// What the numbers are. In files of version 3 there are no extremes.
enum : std::uint64_t { kThresholds, kEachValue, kWithExtremes };

} // namespace

std::vector<std::byte> bytes_of(const LevelMap& levels) {
    std::vector<std::uint64_t> words{0, levels.lossless() ? kEachValue : kThresholds};
    if (const auto& extremes = levels.extremes(); extremes && !levels.lossless()) {
        words[1] = kWithExtremes;
        words.insert(words.end(), {extremes->low, extremes->high});
    }
    if (levels.lossless()) {
        const auto values = levels.distinct();
        words.insert(words.end(), values.begin(), values.end());
    } else {
        words.insert(words.end(), levels.thresholds().begin(), levels.thresholds().end());
    }
    words[0] = checksum_of(std::as_bytes(std::span(words).subspan(1)));
    const auto bytes = std::as_bytes(std::span(words));
    return {bytes.begin(), bytes.end()};
}

std::optional<LevelMap> step_levels(ValueType type, std::span<const std::byte> bytes) {
    std::vector<std::uint64_t> words(bytes.size() / sizeof(std::uint64_t));
    if (words.size() < 2 || bytes.size() % sizeof(std::uint64_t))
        return std::nullopt;
    std::memcpy(words.data(), bytes.data(), bytes.size());
    const bool lossless = words[1] == kEachValue, extremes = words[1] == kWithExtremes;
    if (words.size() < (extremes ? 4u : 2u))
        return std::nullopt;
    const auto ordinals = std::span<const std::uint64_t>(words).subspan(extremes ? 4 : 2);
    if (words[0] != checksum_of(bytes.subspan(sizeof(std::uint64_t))) || words[1] > kWithExtremes ||
        ordinals.size() > LevelMap::kMaxLevels - (lossless ? 0 : 1) ||
        std::ranges::adjacent_find(ordinals, std::greater_equal()) != ordinals.end())
        return std::nullopt;
    if (lossless)
        return LevelMap::of_values(type, ordinals);
    LevelMap levels = LevelMap::of_thresholds(type, ordinals);
    if (extremes)
        levels.set_extremes({words[2], words[3]});
    return levels;
}

} // namespace isochron::index
