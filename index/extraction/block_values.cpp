// Rounds values and isovalues to the values that volume blocks hold.
#include "index/extraction/block_values.h"

#include "index/volume/query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace isochron::index {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The power 2^-e for which `largest` * 2^-e is between 1/2 and 1, or a little more near the end of
/// the type's range, so that neither the power nor half of it is denormal.
template <class Real>
double power_to_one(double largest) {
    constexpr int kMost = std::numeric_limits<Real>::max_exponent - 3;
    if (!(largest > 0) || !std::isfinite(largest))
        return 1.0;
    return std::ldexp(0.5, std::clamp(-std::ilogb(largest), -kMost, kMost));
}

/// The nearest f32, but never an infinity.
float nearest(double value) {
    constexpr double kMost = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -kMost, kMost));
}

/// Rounds values to f32, but keeps each on its own side of all levels.
class Sides {
  public:
    explicit Sides(const BlockLevels& levels) : levels_(levels), count_(levels.rounded.size()) {
        if (count_ > below_.size())
            more_.resize(count_);
        float* const below = count_ > below_.size() ? more_.data() : below_.data();
        for (std::size_t i = 0; i < count_; ++i)
            below[i] = std::nextafter(levels.rounded[i], -kInfinity);
    }
    /// Levels ascend, so the last one at or below the value and the first one above it count.
    float operator()(double relative, double scaled) const {
        auto rounded = static_cast<float>(relative);
        const float* const below = more_.empty() ? below_.data() : more_.data();
        for (std::size_t i = 0; i < count_; ++i)
            rounded = scaled >= levels_.exact[i] ? std::max(rounded, levels_.rounded[i])
                                                 : std::min(rounded, below[i]);
        return scaled == scaled ? rounded : std::numeric_limits<float>::quiet_NaN();
    }

  private:
    const BlockLevels& levels_;
    const std::size_t count_;
    std::array<float, kMostSurfaces> below_{}; ///< the last number below each level
    std::vector<float> more_; ///< the last number below each level, where there are more levels
};

} // namespace

BlockValues::BlockValues(ValueType type, Scaling scaling, double low, double high)
    : type_(type), held_(type), scaling_(scaling), keys_(type, scaling) {
    const double half = 0.5 * high - 0.5 * low; // halves first: the difference may overflow
    double half_in_units = 0;
    if (converts()) {
        held_ = ValueType::f32;
        middle_ = 0.5 * low + 0.5 * high;
        to_units_ = power_to_one<double>(half);
        half_in_units = half * to_units_;
    } else {
        const double a = std::abs((low - scaling.intercept) / scaling.slope);
        const double b = std::abs((high - scaling.intercept) / scaling.slope);
        const double unit = power_to_one<float>(std::max(a, b));
        factor_ = static_cast<float>(scaling.slope < 0 ? -unit : unit);
        half_in_units = std::abs(half / scaling.slope) * unit;
    }
    if (half_in_units > 0 && std::isfinite(half_in_units))
        range_ = std::max(static_cast<float>(2 * half_in_units), std::numeric_limits<float>::min());
}

float BlockValues::stored_level(double isovalue) const {
    return visit_value_type(type_, [&]<class T>(std::type_identity<T>) -> float {
        if constexpr (sizeof(T) > 4 || std::is_same_v<T, std::int32_t>)
            return 0; // converted instead
        else {
            const auto flip = keys_.reversed() ? ~OrderKey{0} : OrderKey{0};
            const std::uint64_t threshold = keys_.threshold(isovalue);
            const std::uint64_t lowest = static_cast<OrderKey>(
                (keys_.reversed() ? highest_ordinal<T>() : lowest_ordinal<T>()) ^ flip);
            const std::uint64_t highest = static_cast<OrderKey>(
                (keys_.reversed() ? lowest_ordinal<T>() : highest_ordinal<T>()) ^ flip);
            if (threshold <= lowest) // all values are on one side: any level beyond them will do
                return keys_.reversed() ? kInfinity : -kInfinity;
            if (threshold > highest)
                return keys_.reversed() ? -kInfinity : kInfinity;
            // The stored value nearest to the isovalue that is not below it.
            const auto first =
                static_cast<float>(from_ordinal<T>(static_cast<OrderKey>(threshold) ^ flip));
            if constexpr (std::is_floating_point_v<T>)
                return first;
            else {
                // The isovalue is between that value and the next one.
                const float next = keys_.reversed() ? first + 1 : first - 1;
                const float inside = std::nextafter(next, first);
                const auto level =
                    static_cast<float>((isovalue - scaling_.intercept) / scaling_.slope);
                return std::clamp(level, std::min(first, inside), std::max(first, inside));
            }
        }
    });
}

BlockLevels BlockValues::levels(std::span<const double> isovalues) const {
    BlockLevels levels;
    levels.exact.assign(isovalues.begin(), isovalues.end());
    std::erase_if(levels.exact, [](double v) { return !std::isfinite(v); }); // no active cells
    std::ranges::sort(levels.exact);
    const auto repeated = std::ranges::unique(levels.exact);
    levels.exact.erase(repeated.begin(), repeated.end());
    for (const double isovalue : levels.exact) {
        float level = converts() ? nearest(relative(isovalue)) : stored_level(isovalue) * factor_;
        if (converts() && !levels.rounded.empty())
            level = std::max(level, std::nextafter(levels.rounded.back(), kInfinity));
        levels.rounded.push_back(level);
    }
    for (const double isovalue : isovalues) {
        const auto found = std::ranges::lower_bound(levels.exact, isovalue);
        const bool finite = std::isfinite(isovalue);
        levels.units.push_back(finite ? levels.rounded[found - levels.exact.begin()] : 0.0f);
    }
    return levels;
}

void BlockValues::convert(const std::byte* stored, std::size_t count, const BlockLevels& levels,
                          std::byte* out) const {
    visit_value_type(type_, [&]<class T>(std::type_identity<T>) {
        if constexpr (sizeof(T) > 4 || std::is_same_v<T, std::int32_t>) {
            const T* values = reinterpret_cast<const T*>(stored);
            const Sides on_its_side(levels);
            for (std::size_t i = 0; i < count; ++i) {
                const double scaled = scaling_(static_cast<double>(values[i]));
                const float held = on_its_side(relative(scaled), scaled);
                std::memcpy(out + i * sizeof held, &held, sizeof held);
            }
        } else {
            std::memcpy(out, stored, count * sizeof(T));
        }
    });
}

} // namespace isochron::index
