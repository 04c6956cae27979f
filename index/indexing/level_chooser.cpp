// Chooses levels from the distinct values of a step, or from a sample of the values.
#include "index/indexing/level_chooser.h"

#include "index/volume/ordinal.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

namespace isochron::index {
namespace {

constexpr std::size_t kSamples = 1 << 14;

/// SplitMix64: different numbers have different hashes. Steele, Lea and Flood, "Fast splittable
/// pseudorandom number generators", OOPSLA 2014, doi:10.1145/2660193.2660195.
std::uint64_t hash_of(std::uint64_t number) {
    number += 0x9e3779b97f4a7c15u;
    number = (number ^ number >> 30) * 0xbf58476d1ce4e5b9u;
    number = (number ^ number >> 27) * 0x94d049bb133111ebu;
    return number ^ number >> 31;
}

/// Collects up to 256 distinct numbers.
class DistinctSet {
  public:
    DistinctSet() : slots_(kSlots, kEmpty) { numbers_.reserve(LevelMap::kMaxLevels + 1); }

    /// @return false when there are more than 256
    bool add(std::uint64_t number) {
        std::size_t slot = number * 0x9e3779b97f4a7c15u >> 54;
        while (slots_[slot] != number) {
            if (slots_[slot] == kEmpty) {
                slots_[slot] = number;
                numbers_.push_back(number);
                return numbers_.size() <= LevelMap::kMaxLevels;
            }
            slot = (slot + 1) % kSlots;
        }
        return true;
    }
    std::vector<std::uint64_t> take() { return std::move(numbers_); }

  private:
    static constexpr std::size_t kSlots = 1 << 10;
    static constexpr std::uint64_t kEmpty = ~std::uint64_t{0}; ///< the ordinal of a NaN only

    std::vector<std::uint64_t> slots_, numbers_;
};

/// A value of a sample, and the weight that the value and the gap below it add to its bin.
struct WeightedValue {
    std::uint64_t ordinal;
    double weight; ///< all weights together are at most 1
};

/// Distributes half of the weight over the values, and half over the range of the finite ones.
std::vector<WeightedValue> weighted(ValueType type, std::span<const std::uint64_t> sorted) {
    const auto value_of = [&](std::uint64_t number) {
        return visit_value_type(type, [&]<class T>(std::type_identity<T>) {
            // Halved, so that no difference overflows.
            return 0.5 * static_cast<double>(from_ordinal<T>(static_cast<Ordinal<T>>(number)));
        });
    };
    std::vector<WeightedValue> values;
    double low = 0, high = 0;
    bool any = false;
    for (std::size_t i = 0, end = 0; i < sorted.size(); i = end) {
        while (end < sorted.size() && sorted[end] == sorted[i])
            ++end;
        values.push_back({sorted[i], 0.5 * double(end - i) / double(sorted.size())});
        const double value = value_of(sorted[i]);
        if (!std::isfinite(value))
            continue;
        if (!any)
            low = value;
        any = true;
        high = value;
    }
    if (!(high > low))
        return values;
    double last = low;
    for (WeightedValue& value : values)
        if (const double here = value_of(value.ordinal); std::isfinite(here)) {
            value.weight += 0.5 * (here - last) / (high - low);
            last = here;
        }
    return values;
}

/// The first values of bins that weigh at most `most` each; a heavier value has its own bin.
std::vector<std::uint64_t> bins_of(std::span<const WeightedValue> values, double most) {
    std::vector<std::uint64_t> thresholds;
    double bin = 0;
    for (const WeightedValue& value : values) {
        if (bin > 0 && bin + value.weight > most) {
            thresholds.push_back(value.ordinal);
            bin = 0;
        }
        bin += value.weight;
    }
    return thresholds;
}

/// Thresholds with the smallest limit of weight that gives at most 256 bins.
std::vector<std::uint64_t> even_thresholds(std::span<const WeightedValue> values) {
    double too_light = 0, light = 1;
    for (int halvings = 0; halvings < 40; ++halvings) {
        const double middle = (too_light + light) / 2;
        (bins_of(values, middle).size() < LevelMap::kMaxLevels ? light : too_light) = middle;
    }
    return bins_of(values, light);
}

} // namespace

void LevelChooser::add(const Part& part, std::span<const std::byte> stored) {
    assert(stored.size() == (part.end - part.first) * size_of(type_));
    if (size_of(type_) == 1)
        return;
    visit_value_type(type_, [&]<class T>(std::type_identity<T>) {
        add_values<T>(part, reinterpret_cast<const T*>(stored.data()));
    });
}

template <class T>
void LevelChooser::add_values(const Part& part, const T* values) {
    if (!many_) {
        DistinctSet distinct;
        bool few = true;
        for (std::size_t i = 0; i < part.end - part.first && few; ++i)
            if (!is_nan(values[i]) && (i == 0 || values[i] != values[i - 1]))
                few = distinct.add(ordinal(values[i]));
        take_distinct(distinct.take());
    }
    // Takes one value at random from each of `count` equal ranges.
    const std::size_t count = std::min(part.all, kSamples);
    for (std::size_t i = part.first * count / part.all; i < count; ++i) {
        const std::size_t first = i * part.all / count;
        const std::size_t end = (i + 1) * part.all / count;
        if (first >= part.end)
            break;
        const std::size_t place = first + hash_of(hash_of(i)) % (end - first);
        if (place < part.first || place >= part.end)
            continue;
        if (const T value = values[place - part.first]; !is_nan(value))
            samples_.push_back(ordinal(value));
    }
}

void LevelChooser::take_distinct(std::vector<std::uint64_t> ordinals) {
    std::sort(ordinals.begin(), ordinals.end());
    std::vector<std::uint64_t> both;
    std::set_union(distinct_.begin(), distinct_.end(), ordinals.begin(), ordinals.end(),
                   std::back_inserter(both));
    many_ |= both.size() > LevelMap::kMaxLevels;
    distinct_ = many_ ? std::vector<std::uint64_t>() : std::move(both);
}

LevelMap LevelChooser::choose() const {
    if (size_of(type_) == 1)
        return LevelMap::of_type(type_);
    if (!many_)
        return LevelMap::of_values(type_, distinct_);
    std::vector<std::uint64_t> sorted = samples_;
    std::sort(sorted.begin(), sorted.end());
    return LevelMap::of_thresholds(type_, even_thresholds(weighted(type_, sorted)));
}

} // namespace isochron::index
