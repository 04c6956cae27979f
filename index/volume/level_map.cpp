// Ranks of stored values among at most 256 levels.
#include "index/volume/level_map.h"

#include "index/volume/ordinal.h"
#include "index/volume/stored_cut.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace isochron::index {
namespace {

std::uint8_t rank_of(std::span<const std::uint64_t> thresholds, std::uint64_t ordinal) {
    const auto above = std::upper_bound(thresholds.begin(), thresholds.end(), ordinal);
    return static_cast<std::uint8_t>(above - thresholds.begin());
}

} // namespace

LevelMap::LevelMap(ValueType type, std::vector<std::uint64_t> thresholds, bool lossless,
                   std::uint64_t lowest)
    : type_(type), thresholds_(std::move(thresholds)), lossless_(lossless), lowest_(lowest) {
    assert(thresholds_.size() < kMaxLevels);
    assert(std::is_sorted(thresholds_.begin(), thresholds_.end()));
    if (size_of(type) > 2)
        return;
    table_.resize(std::size_t{1} << 8 * size_of(type));
    std::size_t rank = 0;
    for (std::size_t ordinal = 0; ordinal < table_.size(); ++ordinal) {
        while (rank < thresholds_.size() && thresholds_[rank] <= ordinal)
            ++rank;
        table_[ordinal] = static_cast<std::uint8_t>(rank);
    }
}

LevelMap LevelMap::of_type(ValueType type) {
    assert(size_of(type) == 1);
    std::vector<std::uint64_t> thresholds(kMaxLevels - 1);
    std::iota(thresholds.begin(), thresholds.end(), 1);
    return {type, std::move(thresholds), true, 0};
}

LevelMap LevelMap::of_values(ValueType type, std::span<const std::uint64_t> distinct) {
    std::vector<std::uint64_t> thresholds(distinct.begin(), distinct.end());
    std::uint64_t lowest = 0;
    if (!thresholds.empty()) {
        lowest = thresholds.front();
        thresholds.erase(thresholds.begin()); // no value is below it
    }
    return {type, std::move(thresholds), true, lowest};
}

LevelMap LevelMap::of_thresholds(ValueType type, std::span<const std::uint64_t> thresholds) {
    return {type, {thresholds.begin(), thresholds.end()}, false, 0};
}

std::vector<std::uint64_t> LevelMap::distinct() const {
    std::vector<std::uint64_t> values{lowest_};
    values.insert(values.end(), thresholds_.begin(), thresholds_.end());
    return values;
}

std::optional<LevelMap::Cut> LevelMap::cut(const Scaling& scaling, double isovalue) const {
    const auto stored = stored_cut(type_, scaling, isovalue);
    if (!stored || (lossless_ && *stored <= lowest_))
        return std::nullopt;
    if (extremes_ && (*stored <= extremes_->low || *stored > extremes_->high))
        return std::nullopt;
    const bool on_threshold = std::binary_search(thresholds_.begin(), thresholds_.end(), *stored);
    const std::uint8_t rank = rank_of(thresholds_, *stored);
    if (on_threshold)
        return Cut{rank, true};
    if (!lossless_)
        return Cut{rank, false};
    // Values of rank `rank` are below the cut; values of the next rank are not.
    if (rank == thresholds_.size())
        return std::nullopt;
    return Cut{static_cast<std::uint8_t>(rank + 1), true};
}

void LevelMap::ranks(std::span<const std::byte> stored, std::span<std::uint8_t> out) const {
    visit_value_type(type_, [&]<class T>(std::type_identity<T>) {
        assert(stored.size() == out.size() * sizeof(T));
        const T* values = reinterpret_cast<const T*>(stored.data());
        if constexpr (sizeof(T) <= 2) {
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = table_[ordinal(values[i])];
        } else {
            // Binary search without branches, which could not be predicted, among 255 thresholds;
            // those added at the end are above all values.
            std::array<std::uint64_t, kMaxLevels - 1> padded;
            padded.fill(~std::uint64_t{0});
            std::copy(thresholds_.begin(), thresholds_.end(), padded.begin());
            for (std::size_t i = 0; i < out.size(); ++i) {
                const std::uint64_t number = ordinal(values[i]);
                std::size_t rank = 0;
                for (std::size_t half = kMaxLevels / 2; half > 0; half /= 2)
                    rank += half * (padded[rank + half - 1] <= number);
                out[i] = static_cast<std::uint8_t>(rank);
            }
        }
    });
}

} // namespace isochron::index
