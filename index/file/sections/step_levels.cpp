// Levels of a step as bytes, and back.
#include "index/file/sections/step_levels.h"

#include "index/file/sections/file_layout.h"

#include <algorithm>
#include <cstring>

namespace isochron::index {

std::vector<std::byte> bytes_of(const LevelMap& levels) {
    std::vector<std::uint64_t> words{0, levels.lossless() ? 1u : 0u};
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
    const auto ordinals = std::span<const std::uint64_t>(words).subspan(2);
    const bool lossless = words[1] == 1;
    if (words[0] != checksum_of(bytes.subspan(sizeof(std::uint64_t))) || words[1] > 1 ||
        ordinals.size() > LevelMap::kMaxLevels - (lossless ? 0 : 1) ||
        std::ranges::adjacent_find(ordinals, std::greater_equal()) != ordinals.end())
        return std::nullopt;
    return lossless ? LevelMap::of_values(type, ordinals) : LevelMap::of_thresholds(type, ordinals);
}

} // namespace isochron::index
