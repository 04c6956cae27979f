// What the definitions of lost and thinned cells say, without any care for speed.
#pragma once

#include "index/detail/detail_regions.h"
#include "index/search/layer_search.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

namespace isochron::index {

using SlowPlace = std::array<unsigned, 3>;

inline unsigned slow_level(const CellPoint& p) {
    return static_cast<unsigned>(std::countr_zero(static_cast<unsigned>(p.x)));
}
/// The cell's lowest vertex.
inline SlowPlace slow_low(const CellPoint& p) {
    const unsigned size = 1u << slow_level(p);
    return {(p.x - size) / 2, (p.y - size) / 2, (p.z - size) / 2};
}

/// The cells of a level in which some drawn cell lies, at least in part.
inline std::set<SlowPlace> slow_drawn(const Grid& grid, std::span<const CellPoint> drawn,
                                      unsigned level) {
    std::set<SlowPlace> at;
    for (const CellPoint& p : drawn) {
        const SlowPlace low = slow_low(p);
        const unsigned size = 1u << slow_level(p), stride = std::min(size, 1u << level);
        for (unsigned z = 0; z < size; z += stride)
            for (unsigned y = 0; y < size; y += stride)
                for (unsigned x = 0; x < size; x += stride)
                    if (low[0] + x < grid.cells()[0] && low[1] + y < grid.cells()[1] &&
                        low[2] + z < grid.cells()[2])
                        at.insert(
                            {(low[0] + x) >> level, (low[1] + y) >> level, (low[2] + z) >> level});
    }
    return at;
}

/// The lost cells of an index with level 0, at places of mixed levels.
inline std::vector<CellPoint> lost_slowly(const std::shared_ptr<const IndexFile>& file,
                                          const Query& query, std::span<const CellPoint> drawn,
                                          std::span<const std::uint8_t> levels) {
    const DetailRegions regions(file->info().grid);
    CellSet all;
    all.query = query;
    EXPECT_TRUE(
        LayerSearch(file).search(step_in_chunks(*file, query.instant), all, true, true, {}));
    std::map<unsigned, std::set<SlowPlace>> drawn_at;
    for (const unsigned level : levels)
        if (!drawn_at.contains(level))
            drawn_at[level] = slow_drawn(file->info().grid, drawn, level);
    std::vector<CellPoint> lost;
    for (CellPoint p : all.points) {
        const unsigned edge = regions.edge();
        const unsigned level = levels[regions.number({p.x / edge, p.y / edge, p.z / edge})];
        const SlowPlace cell{static_cast<unsigned>(p.x) >> level,
                             static_cast<unsigned>(p.y) >> level,
                             static_cast<unsigned>(p.z) >> level};
        if (level == 0 || drawn_at[level].contains(cell))
            continue;
        for (std::uint16_t* at : {&p.x, &p.y, &p.z})
            *at = static_cast<std::uint16_t>(2 * *at + 1);
        lost.push_back(p);
    }
    return lost;
}

/// Thins the cells of level 0 of all surfaces to about `most`: those stay whose places have the lowest
/// hashes. @return whether some were left out
inline bool thin_slowly(std::vector<std::vector<CellPoint>>& surfaces, std::uint64_t most) {
    const auto stirred = [](std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    };
    std::uint64_t all = 0;
    for (const auto& surface : surfaces)
        all += surface.size();
    if (all <= most)
        return false;
    const double share = static_cast<double>(most) / static_cast<double>(all);
    for (auto& surface : surfaces)
        std::erase_if(surface, [&](const CellPoint& p) {
            const SlowPlace at = slow_low(p);
            const std::uint64_t row = stirred((std::uint64_t{at[2]} << 32) + at[1]);
            return std::ldexp(static_cast<double>(stirred(row + at[0]) >> 32), -32) >= share;
        });
    return true;
}

} // namespace isochron::index
