// Makes tiles: the ranks of the vertices of every brick.
#include "index/scan/brick_tiles.h"
#include "index/scan/bricks.h"
#include "index/system/parallel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/scan/tile_build.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include "index/scan/tile_ranks_inl.h"
#include "index/scan/vertex_bits_inl.h"

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

/// The vertices of a brick, with room for whole vectors. Beyond the border the last one repeats.
template <class F>
struct TileVertices {
    static constexpr std::size_t kCount = kPlanes * kPlaneRanks, kPadded = (kCount + 15) / 16 * 16;
    alignas(64) std::array<F, kPadded> of;

    template <class T>
    void take(const Grid& grid, const T* stored, const Place& at) {
        const auto [nx, ny, nz] = grid.vertices;
        const std::size_t width = std::min<std::size_t>(kAcross, nx - at.x);
        F* to = of.data();
        for (std::uint32_t z = 0; z < kPlanes; ++z)
            for (std::uint32_t y = 0; y < kTileRows; ++y, to += kAcross) {
                const T* row =
                    stored +
                    (std::size_t{std::min(at.z + z, nz - 1)} * ny + std::min(at.y + y, ny - 1)) *
                        nx +
                    at.x;
                if (HWY_LIKELY(width == kAcross)) {
                    for (std::size_t x = 0; x < kAcross; ++x)
                        to[x] = static_cast<F>(row[x]);
                } else {
                    for (std::size_t x = 0; x < kAcross; ++x)
                        to[x] = static_cast<F>(row[std::min(x, width - 1)]);
                }
            }
        std::fill(to, of.data() + kPadded, to[-1]);
    }
};

template <class T>
void fill_tile(const StepValues& values, const T* stored, const Place& at, std::uint8_t* tile) {
    using F = Rankable<T>;
    using Limits = std::numeric_limits<F>;
    TileVertices<F> vertices;
    vertices.take(values.grid, stored, at);
    const hn::CappedTag<F, 16> d;
    auto lows = hn::Set(d, Limits::max()), highs = hn::Set(d, Limits::lowest());
    for (std::size_t i = 0; i < vertices.kPadded; i += hn::Lanes(d)) {
        const auto v = hn::Load(d, vertices.of.data() + i);
        const auto finite =
            hn::And(hn::Ge(v, hn::Set(d, Limits::lowest())), hn::Le(v, hn::Set(d, Limits::max())));
        lows = hn::Min(lows, hn::IfThenElse(finite, v, lows));
        highs = hn::Max(highs, hn::IfThenElse(finite, v, highs));
    }
    F low = hn::GetLane(hn::MinOfLanes(d, lows));
    const F high = hn::GetLane(hn::MaxOfLanes(d, highs));
    F scale = F{kHighestRank} / (high - low);
    if (!(high > low) || !(scale > 0) || !std::isfinite(scale)) {
        low = high >= low ? low : 0;
        scale = 1;
    }
    std::array<std::uint8_t, vertices.kPadded> ranks;
    for (std::size_t i = 0; i < vertices.kPadded; i += hn::Lanes(d)) {
        const auto v = hn::Load(d, vertices.of.data() + i);
        auto rank = hn::Mul(hn::Sub(v, hn::Set(d, low)), hn::Set(d, scale)); // as in rank_of
        rank = hn::IfThenElse(hn::Gt(rank, hn::Zero(d)), rank, hn::Zero(d));
        const auto most = hn::Set(d, F{kHighestRank});
        rank = hn::IfThenElse(hn::Lt(rank, most), rank, most);
        rank = hn::IfThenElse(hn::Eq(v, v), rank, hn::Set(d, F{kNoRank}));
        const hn::Rebind<std::int32_t, decltype(d)> whole;
        const hn::Rebind<std::uint8_t, decltype(d)> bytes;
        if constexpr (sizeof(F) == 4)
            hn::StoreU(hn::DemoteTo(bytes, hn::ConvertTo(whole, rank)), bytes, ranks.data() + i);
        else
            hn::StoreU(hn::DemoteTo(bytes, hn::DemoteTo(whole, rank)), bytes, ranks.data() + i);
    }
    std::memset(tile, kNoRank, kTileBytes);
    std::memcpy(tile, ranks.data(), vertices.kCount);
    tile[kMissing] = std::is_floating_point_v<T> &&
                     std::memchr(ranks.data(), kNoRank, vertices.kCount) != nullptr;
    const Ranking ranking{low, scale};
    std::memcpy(tile + kTileBytes - sizeof ranking, &ranking, sizeof ranking);
}

/// Fills the tiles of one layer of bricks.
void fill_layer(const StepValues& values, std::size_t step, std::uint32_t layer,
                std::uint8_t* tiles) {
    const auto bricks = BrickGrid(values.grid).bricks();
    const std::uint32_t count = bricks[0] * bricks[1];
    visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        const T* stored = values.step<T>(step).data();
        for (std::uint32_t brick = layer * count; brick < (layer + 1) * count; ++brick)
            fill_tile(values, stored, Place(brick, bricks),
                      tiles + std::size_t{brick} * kTileBytes);
    });
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(fill_layer);

std::size_t tile_bytes(const Grid& grid) {
    return BrickGrid(grid).count() * kTileBytes;
}

bool build_tiles(const StepValues& values, std::size_t step, std::span<std::uint8_t> out,
                 unsigned threads, const std::stop_token& stop) {
    assert(out.size() == tile_bytes(values.grid));
    parallel_for(BrickGrid(values.grid).bricks()[2], threads,
                 [&](std::size_t layer, unsigned) {
                     if (stop.stop_requested())
                         return;
                     HWY_DYNAMIC_DISPATCH(fill_layer)
                     (values, step, static_cast<std::uint32_t>(layer), out.data());
                 },
                 {});
    return !stop.stop_requested();
}

} // namespace isochron::index
#endif
