// Blends bounds: of levels, by tables of their ranks.
#include "index/file/blended_ranks.h"

#include "index/volume/instant.h"
#include "index/volume/ordinal.h"
#include "index/volume/stored_cut.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace isochron::index {
namespace {

constexpr std::size_t kRanks = LevelMap::kMaxLevels;

/// The scaled values of a stored one, which may be infinite: in between, these are missing.
double scaled_of(ValueType type, const Scaling& scaling, std::uint64_t ordinal) {
    const double most = std::numeric_limits<double>::max();
    return visit_value_type(type, [&]<class T>(std::type_identity<T>) {
        const std::uint64_t number =
            std::clamp<std::uint64_t>(ordinal, lowest_ordinal<T>(), highest_ordinal<T>());
        const T value = from_ordinal<T>(static_cast<Ordinal<T>>(number));
        return std::clamp(scaling(static_cast<double>(value)), -most, most);
    });
}

/// By rank: the scaled value of the smallest, or of the largest, stored value that has it.
struct ValuesOfRanks {
    std::array<double, kRanks> values{};
    std::size_t count = 0;
    std::span<const double> all() const { return std::span(values).first(count); }
};
ValuesOfRanks values_of_ranks(const LevelMap& levels, const Scaling& scaling, bool of_last) {
    ValuesOfRanks of;
    of.count = levels.levels();
    const auto thresholds = levels.thresholds();
    const LevelMap::Extremes all = levels.extremes().value_or(LevelMap::Extremes{});
    const std::vector<std::uint64_t> distinct =
        levels.lossless() ? levels.distinct() : std::vector<std::uint64_t>();
    for (std::size_t rank = 0; rank < of.count; ++rank) {
        std::uint64_t ordinal = 0;
        if (levels.lossless())
            ordinal = distinct[rank];
        else if (of_last)
            ordinal =
                rank + 1 == of.count ? all.high : std::max<std::uint64_t>(thresholds[rank], 1) - 1;
        else
            ordinal = rank == 0 ? all.low : thresholds[rank - 1];
        of.values[rank] = scaled_of(levels.type(), scaling, ordinal);
    }
    return of;
}

/// Levels of blends: scaled values, ascending, and the same as ordinals of what blends are stored as.
struct Thresholds {
    std::vector<double> scaled;
    std::vector<std::uint64_t> ordinals;

    /// The thresholds between which the blends' ranks lie. @param isovalues empty: the thresholds
    /// of `levels`
    Thresholds(const LevelMap& levels, const Scaling& scaling, const Blend& blend,
               std::span<const double> isovalues) {
        std::vector<double> all(isovalues.begin(), isovalues.end());
        if (isovalues.empty())
            for (const std::uint64_t threshold : levels.thresholds())
                all.push_back(scaled_of(levels.type(), scaling, threshold));
        std::ranges::sort(all); // a negative slope reverses them
        for (const double value : all) {
            const auto cut = stored_cut(blend.type(), blend.scaling(), value);
            if (!cut || (!ordinals.empty() && ordinals.back() == *cut))
                continue; // it divides no blends, or the same ones
            scaled.push_back(value);
            ordinals.push_back(*cut);
        }
    }
};

/// Whether a blend is at a threshold or above.
bool reaches(double a, double b, std::uint32_t n, double threshold) {
    constexpr double kWhole = Instant::kFractions;
    const double first = (kWhole - n) * a, second = n * b,
                 over = first + second - kWhole * threshold;
    const double error =
        0x1p-50 * (std::abs(first) + std::abs(second) + kWhole * std::abs(threshold)) +
        std::numeric_limits<double>::min();
    if (over > error || over < -error)
        return over > 0;
    return blended(a, b, n) >= threshold;
}

} // namespace

BlendedRanks::BlendedRanks(const LevelMap& now, const LevelMap& next, const Scaling& scaling,
                           const Blend& blend, std::uint32_t n, std::span<const double> isovalues)
    : reversed_(scaling.slope < 0) {
    const Thresholds of_blends(now, scaling, blend, isovalues);
    const std::vector<double>& thresholds = of_blends.scaled;
    levels_ =
        std::make_shared<const LevelMap>(LevelMap::of_thresholds(blend.type(), of_blends.ordinals));
    low_ = table_of(now, next, scaling, n, thresholds, reversed_);
    high_ = table_of(now, next, scaling, n, thresholds, !reversed_);
}

BlendedRanks::Table BlendedRanks::table_of(const LevelMap& now, const LevelMap& next,
                                           const Scaling& scaling, std::uint32_t n,
                                           std::span<const double> thresholds, bool of_last) {
    const ValuesOfRanks of_now = values_of_ranks(now, scaling, of_last),
                        of_next = values_of_ranks(next, scaling, of_last);
    return {of_now.all(), of_next.all(), n, thresholds};
}

BlendedRanks::Table::Table(std::span<const double> now, std::span<const double> next,
                           std::uint32_t n, std::span<const double> thresholds) {
    if (thresholds.size() <= Blend::kMostIsovalues && std::ranges::is_sorted(now) &&
        std::ranges::is_sorted(next)) {
        for (const double threshold : thresholds) {
            Reach& reach = few.emplace_back();
            reach.fill(kRanks);
            // The larger the first value, the smaller the second one with which the blend is there.
            std::size_t k = next.size();
            for (std::size_t i = 0; i < now.size(); ++i) {
                while (k > 0 && reaches(now[i], next[k - 1], n, threshold))
                    --k;
                reach[i] = static_cast<std::uint16_t>(k);
            }
            const auto first_of = [&](std::span<const double> values) {
                return static_cast<std::uint16_t>(std::ranges::lower_bound(values, threshold) -
                                                  values.begin());
            };
            alone.push_back({first_of(now), first_of(next)});
        }
        return;
    }
    all.resize(kRanks * kRanks);
    const Blend blend(ValueType::f64, {}, n);
    std::array<double, kRanks> same{}, row{};
    for (std::size_t i = 0; i < now.size(); ++i) {
        std::fill_n(same.begin(), next.size(), now[i]);
        blend(std::as_bytes(std::span(same).first(next.size())), std::as_bytes(next),
              reinterpret_cast<std::byte*>(row.data()));
        std::size_t rank = 0; // rank of the value before, from which the next one is not far
        for (std::size_t k = 0; k < next.size(); ++k) {
            while (rank < thresholds.size() && thresholds[rank] <= row[k])
                ++rank;
            while (rank > 0 && thresholds[rank - 1] > row[k])
                --rank;
            all[i * kRanks + k] = static_cast<std::uint8_t>(rank);
        }
    }
}

void BlendedRanks::blend(std::span<std::uint8_t> low, std::span<std::uint8_t> high,
                         std::span<const std::uint8_t> low_next,
                         std::span<const std::uint8_t> high_next) const {
    for (std::size_t i = 0; i < low.size(); ++i)
        blend(low[i], high[i], low_next[i], high_next[i]);
}

std::vector<std::uint8_t> BlendedRanks::candidates(std::span<const std::uint8_t> now,
                                                   std::span<const std::uint8_t> next,
                                                   const LevelMap::Cut& cut,
                                                   std::vector<std::uint32_t>& found) const {
    const std::size_t count = now.size() / 2;
    std::vector<std::uint8_t> bricks(2 * count);
    const auto low = std::span(bricks).first(count), high = std::span(bricks).last(count);
    // Where both steps lie on one side, so do their blends. A plain loop, which the compiler makes
    // one of vectors, leaves few others.
    std::array<std::array<std::uint16_t, 2>, 2> alone{{{kRanks, kRanks}, {0, 0}}}; // low, high
    if (cut.exact && !reversed_ && !low_->few.empty())
        alone = {low_->alone[cut.threshold - 1u], high_->alone[cut.threshold - 1u]};
    for (std::size_t i = 0; i < count; ++i) {
        const bool below = (now[i] < alone[0][0]) | (next[i] < alone[0][1]);
        const bool above = (now[count + i] >= alone[1][0]) | (next[count + i] >= alone[1][1]);
        low[i] = static_cast<std::uint8_t>((below & above) - 1);
    }
    const auto blend_one = [&](std::size_t i) {
        if (low[i] != 0)
            return;
        low[i] = now[i];
        high[i] = now[count + i];
        blend(low[i], high[i], next[i], next[count + i]);
        if (cut.may_hold(low[i], high[i])) {
            found.push_back(static_cast<std::uint32_t>(i));
        } else {
            low[i] = 255;
            high[i] = 0;
        }
    };
    constexpr std::size_t kTogether = sizeof(std::uint64_t);
    for (std::size_t first = 0; first < count; first += kTogether) {
        std::uint64_t some = 0;
        std::memcpy(&some, low.data() + first, std::min(kTogether, count - first));
        if (first + kTogether <= count && some == ~std::uint64_t{0})
            continue;
        for (std::size_t i = first; i < std::min(first + kTogether, count); ++i)
            blend_one(i);
    }
    return bricks;
}

std::uint64_t BlendedRanks::bytes() const {
    return sizeof(*this) + 2 * (low_->all.size() + low_->few.size() * sizeof(Table::Reach)) +
           levels_->thresholds().size() * sizeof(std::uint64_t);
}

} // namespace isochron::index
