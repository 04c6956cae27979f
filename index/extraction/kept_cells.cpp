// Copies kept cells, and finds which coarser cells stand for some.
#include "index/extraction/kept_cells.h"

#include "index/detail/detail_regions.h"
#include "index/volume/cell_walk.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace isochron::index {
namespace {

using At = std::array<std::uint32_t, 3>;

/// Cells of one level, in a set of numbers.
class CellsOfLevel {
  public:
    void add(const At& cell) {
        if (const std::uint64_t key = key_of(cell); keys_.empty() || keys_.back() != key)
            keys_.push_back(key);
    }
    void finish() {
        std::ranges::sort(keys_);
        const auto again = std::ranges::unique(keys_);
        keys_.erase(again.begin(), again.end());
    }
    bool has(const At& cell) const { return std::ranges::binary_search(keys_, key_of(cell)); }
    bool has_around(const At& cell) const {
        for (std::uint32_t z = cell[2] - 1; z != cell[2] + 2; ++z)
            for (std::uint32_t y = cell[1] - 1; y != cell[1] + 2; ++y)
                for (std::uint32_t x = cell[0] - 1; x != cell[0] + 2; ++x)
                    if (has({x, y, z}))
                        return true;
        return false;
    }

  private:
    static std::uint64_t key_of(const At& cell) { // 2^16 along each axis, and one beyond
        return (std::uint64_t{cell[2] & 0x1fffffu} << 42) |
               (std::uint64_t{cell[1] & 0x1fffffu} << 21) | (cell[0] & 0x1fffffu);
    }
    std::vector<std::uint64_t> keys_;
};

/// Which cells of a level hold cells that are kept, and that are not.
struct LevelOfKept {
    CellsOfLevel kept, hidden;
    bool keeps(const At& cell) const {
        return kept.has(cell) || (!hidden.has(cell) && kept.has_around(cell));
    }
};

LevelOfKept level_of(const Grid& grid, const CellSet& set, const KeptPieces& kept, unsigned level) {
    LevelOfKept found;
    const auto add = [&](std::size_t i, const At& at) {
        (kept.keeps(i) ? found.kept : found.hidden)
            .add({at[0] >> level, at[1] >> level, at[2] >> level});
    };
    CellWalk walk(grid);
    const bool by_points = has_wide_ids(grid);
    for (std::size_t i = 0; i < set.ids.size(); ++i)
        if (by_points) {
            add(i, {set.points[i].x, set.points[i].y, set.points[i].z});
        } else {
            walk.to(set.ids[i]);
            add(i, {walk.x(), walk.y(), walk.z()});
        }
    found.kept.finish();
    found.hidden.finish();
    return found;
}

} // namespace

CellSet cells_of_kept(const CellSet& from, const KeptPieces& kept) {
    CellSet to = from;
    to.mesh.reset();
    if (kept.cells.empty())
        return to;
    std::uint32_t count = 0;
    to.rows.clear();
    for (std::size_t i = 0; i < from.ids.size(); ++i) {
        if (!kept.keeps(i))
            continue;
        to.ids[count] = from.ids[i];
        if (!from.points.empty()) {
            const CellPoint& point = to.points[count] = from.points[i];
            if (to.rows.empty() || to.rows.back().y != point.y || to.rows.back().z != point.z)
                to.rows.push_back({point.y, point.z, count});
        }
        ++count;
    }
    to.ids.resize(count);
    to.points.resize(from.points.empty() ? 0 : count);
    return to;
}

void keep_levels(const Grid& grid, std::span<const CellSet> whole, std::span<const KeptPieces> kept,
                 Extraction& coarse) {
    const bool colored = !coarse.colors.empty();
    std::size_t first = 0, left = 0; // colors of all surfaces
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::vector<CellPoint>& points = coarse.surfaces[i].points;
        std::vector<LevelOfKept> levels;
        if (!kept[i].cells.empty())
            for (unsigned level = 0; level <= coarse.coarsest; ++level)
                levels.push_back(level_of(grid, whole[i], kept[i], level));
        std::size_t count = 0;
        for (std::size_t n = 0; n < points.size(); ++n) {
            const CellPoint point = points[n];
            const unsigned level = level_of_center(point.x);
            const auto along = [&](std::uint32_t doubled) { return doubled >> (level + 1); };
            if (!levels.empty() &&
                !levels[level].keeps({along(point.x), along(point.y), along(point.z)}))
                continue;
            points[count++] = point;
            if (colored)
                coarse.colors[left++] = coarse.colors[first + n];
        }
        first += points.size();
        points.resize(count);
    }
    if (colored)
        coarse.colors.resize(left);
}

} // namespace isochron::index
