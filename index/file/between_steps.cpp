// Blends chunks, the tables of layers, and whole steps.
#include "index/file/between_steps.h"

#include "index/file/chunks/spare_memory.h"
#include "index/system/huge_pages.h"
#include "index/volume/ordinal.h"
#include "index/volume/stored_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::uint64_t kKeptBytes = 128 << 20; ///< most kept of blended chunks
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

struct BlendedChunk : Chunk {
    explicit BlendedChunk(std::shared_ptr<SpareMemory> spare_memory)
        : spare(std::move(spare_memory)), memory(spare->take()) {}
    ~BlendedChunk() { spare->give_back(std::move(memory)); }
    BlendedChunk(const BlendedChunk&) = delete;
    BlendedChunk& operator=(const BlendedChunk&) = delete;

    std::shared_ptr<SpareMemory> spare;
    SpareMemory::Doubles memory; ///< memory in doubles, for their alignment
};

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

std::shared_ptr<const BlendedRanks> BlendedRanks::of(const ChunkStore& store, Instant at,
                                                     const Blend& blend) {
    const auto make = [&] {
        return std::make_shared<const BlendedRanks>(
            *store.levels(at.step), *store.levels(at.step + 1), store.info().scaling, blend,
            at.fraction, blend.isovalues());
    };
    if (!blend.isovalues().empty()) // which is sooner done than said
        return make();
    ByteCache& kept = store.for_blends().ranks;
    const ByteCache::Key key{0, at.number()};
    if (auto found = kept.find<BlendedRanks>(key))
        return found;
    auto made = make();
    kept.add(key, made, made->bytes());
    return made;
}

BetweenSteps::BetweenSteps(const ChunkStore& store, Instant at, const Blend& blend)
    : store_(store), at_(at), blend_(blend), kept_(kKeptBytes) {}

const BlendedRanks& BetweenSteps::ranks() const {
    std::call_once(made_ranks_, [&] { ranks_ = BlendedRanks::of(store_, at_, blend_); });
    return *ranks_;
}

ChunkLayerPtr BetweenSteps::layer(std::uint32_t layer) const {
    const ByteCache::Key key{1, layer};
    if (auto kept = kept_.find<ChunkLayer>(key))
        return kept;
    const auto made = std::make_shared<ChunkLayer>(*store_.layer(at_.step, layer));
    if (store_.has_bricks()) {
        const ChunkLayerPtr next = store_.layer(at_.step + 1, layer);
        ranks().blend(made->low, made->high, next->low, next->high);
    }
    kept_.add(key, made, made->low.size() * (sizeof(std::uint64_t) + sizeof(std::uint32_t) + 2));
    return made;
}

void BetweenSteps::blend_bricks(const Chunk& now, const Chunk& next, Chunk& out) const {
    out.bricks = now.bricks;
    if (store_.has_bricks())
        ranks().blend(std::span(out.bricks).first(kBricksOfChunk),
                      std::span(out.bricks).last(kBricksOfChunk),
                      std::span(next.bricks).first(kBricksOfChunk),
                      std::span(next.bricks).last(kBricksOfChunk));
}

ChunkPtr BetweenSteps::blended(const Chunk& now, const Chunk& next) const {
    const auto made = std::make_shared<BlendedChunk>(store_.for_blends().spare);
    made->size = now.size;
    blend_bricks(now, next, *made);
    const std::size_t count = now.values.size() / size_of(store_.info().type);
    const std::size_t bytes = count * size_of(blend_.type());
    auto* const values = reinterpret_cast<std::byte*>(made->memory.get());
    blend_(now.values, next.values, values);
    made->values = {values, bytes};
    return made;
}

std::vector<ChunkPtr> BetweenSteps::pairs(std::uint32_t layer,
                                          std::span<const std::uint32_t> places,
                                          const std::stop_token& stop) const {
    const std::vector<std::uint32_t> later(places.begin(), places.end());
    store_.expect(at_.step + 1, layer, {&later, 1}); // before the first step is waited for
    std::vector<ChunkPtr> now = store_.chunks(at_.step, layer, places, stop);
    std::vector<ChunkPtr> next = store_.chunks(at_.step + 1, layer, places, stop);
    std::vector<ChunkPtr> pairs;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto pair = std::make_shared<ChunkPair>();
        pair->size = now[i]->size;
        pair->values = now[i]->values;
        blend_bricks(*now[i], *next[i], *pair);
        pair->now = std::move(now[i]);
        pair->next = std::move(next[i]);
        pairs.push_back(pair);
    }
    return pairs;
}

std::vector<ChunkPtr> BetweenSteps::chunks(std::uint32_t layer,
                                           std::span<const std::uint32_t> places,
                                           const std::stop_token& stop) const {
    std::vector<ByteCache::Key> keys;
    for (const std::uint32_t place : places)
        keys.push_back({2, std::uint64_t{layer} << 32 | place});
    std::vector<ChunkPtr> found = kept_.find_all<Chunk>(keys);
    std::vector<std::uint32_t> missing;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!found[i])
            missing.push_back(places[i]);
    if (missing.empty())
        return found;
    store_.expect(at_.step + 1, layer, {&missing, 1}); // before the first step is waited for
    const std::vector<ChunkPtr> now = store_.chunks(at_.step, layer, missing, stop);
    const std::vector<ChunkPtr> next = store_.chunks(at_.step + 1, layer, missing, stop);
    std::vector<ByteCache::Entry> entries;
    for (std::size_t i = 0, at = 0; i < places.size(); ++i) {
        if (found[i])
            continue;
        stop_if_asked(stop);
        found[i] = blended(*now[at], *next[at]);
        entries.push_back({keys[i], found[i], found[i]->values.size() + sizeof(BlendedChunk)});
        ++at;
    }
    kept_.add_all(std::move(entries));
    return found;
}

std::uint64_t BetweenSteps::expect(std::uint32_t first,
                                   std::span<const std::vector<std::uint32_t>> places) const {
    return store_.expect(at_.step, first, places) + store_.expect(at_.step + 1, first, places);
}

std::uint64_t BetweenSteps::fetch(std::uint32_t layer, std::span<const std::uint32_t> places,
                                  const std::stop_token& stop) const {
    return store_.fetch(at_.step, layer, places, stop) +
           store_.fetch(at_.step + 1, layer, places, stop);
}

LoadedStep BetweenSteps::whole(const LoadedStep& now, const LoadedStep& next, Instant at,
                               const ChunkStore* store, const Blend& blend) {
    struct Owner {
        LargeMemory values;
        std::vector<std::uint8_t> bricks;
    };
    const auto owner = std::make_shared<Owner>();
    LoadedStep made{.values = now.values};
    made.values.type = blend.type();
    made.values.scaling = blend.scaling();
    const std::size_t bytes = now.values.grid.vertex_count() * size_of(blend.type());
    owner->values = large_memory(bytes);
    blend(now.values.step_bytes(at.step), next.values.step_bytes(at.step + 1), owner->values.get());
    made.values.first = owner->values.get();
    made.values.first_step = at.step;
    made.values.stride = (bytes + 7) / 8 * 8;
    if (!now.bricks.empty() && store) {
        owner->bricks.assign(now.bricks.begin(), now.bricks.end());
        const std::size_t count = now.bricks.size() / 2;
        const std::span<std::uint8_t> bricks = owner->bricks;
        BlendedRanks::of(*store, at, blend)
            ->blend(bricks.first(count), bricks.subspan(count, count), next.bricks.first(count),
                    next.bricks.subspan(count, count));
        made.bricks = bricks;
    }
    made.owner = owner;
    return made;
}

} // namespace isochron::index
