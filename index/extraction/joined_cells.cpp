// Merges kept cells and others.
#include "index/extraction/joined_cells.h"

#include "index/volume/cell_walk.h"

#include <algorithm>

namespace isochron::index {
namespace {

/// Appends cells to a set in the order of ids.
class CellJoiner {
  public:
    CellJoiner(const CellSet& earlier, const CellSet& others, CellSet& set)
        : shaded_(!others.points.empty() || !earlier.points.empty()), set_(set) {
        const std::size_t most = earlier.ids.size() + others.ids.size();
        set_.ids.resize(most);
        set_.points.resize(shaded_ ? most : 0);
        set_.rows.clear();
    }

    void add(const CellSet& from, std::size_t i) {
        set_.ids[count_] = from.ids[i];
        if (shaded_) {
            const CellPoint& point = set_.points[count_] = from.points[i];
            if (set_.rows.empty() || set_.rows.back().y != point.y || set_.rows.back().z != point.z)
                set_.rows.push_back({point.y, point.z, count_});
        }
        ++count_;
    }

    std::uint32_t count() const { return count_; }
    void finish() {
        set_.ids.resize(count_);
        set_.points.resize(shaded_ ? count_ : 0);
    }

  private:
    bool shaded_;
    CellSet& set_;
    std::uint32_t count_ = 0;
};

} // namespace

double share_kept(const Grid& grid, std::span<const CellId> ids, const StayingCells& staying) {
    constexpr std::size_t kLooked = 16;
    std::size_t looked = 0, kept = 0;
    CellWalk walk(grid);
    for (std::size_t i = 0; i < ids.size(); i += kLooked, ++looked) {
        walk.to(ids[i]);
        kept += staying.has_cell(walk.x(), walk.y(), walk.z()) ? 1 : 0;
    }
    return looked == 0 ? 1.0 : static_cast<double>(kept) / static_cast<double>(looked);
}

SurfaceChange join_cells(const Grid& grid, const CellSet& earlier, const StayingCells& staying,
                         const CellSet& others, CellSet& set, std::vector<std::uint32_t>* kept,
                         std::vector<std::uint8_t>* inner) {
    SurfaceChange change;
    CellJoiner joiner(earlier, others, set);
    const auto clear = [&](auto* values) {
        if (!values)
            return;
        values->clear();
        values->reserve(earlier.ids.size() + others.ids.size());
    };
    clear(kept);
    clear(inner);
    CellWalk walk(grid);
    const auto add = [&](const CellSet& from, std::size_t i, std::uint32_t place) {
        joiner.add(from, i);
        if (kept)
            kept->push_back(place);
        if (inner)
            inner->push_back(place != EarlierMesh::kNone &&
                             staying.has_around(walk.x(), walk.y(), walk.z()));
    };
    std::size_t other = 0;
    for (std::uint32_t i = 0; i < earlier.ids.size(); ++i) {
        const CellId id = earlier.ids[i];
        for (; other < others.ids.size() && others.ids[other] < id; ++other) {
            change.added.push_back(joiner.count());
            add(others, other, EarlierMesh::kNone);
        }
        walk.to(id);
        if (staying.has_cell(walk.x(), walk.y(), walk.z())) {
            ++set.reused;
            add(earlier, i, i);
        } else if (other < others.ids.size() && others.ids[other] == id) {
            add(others, other++, EarlierMesh::kNone);
        } else {
            change.removed.push_back(i);
        }
    }
    for (; other < others.ids.size(); ++other) {
        change.added.push_back(joiner.count());
        add(others, other, EarlierMesh::kNone);
    }
    joiner.finish();
    set.candidates = others.candidates + set.reused;
    return change;
}

} // namespace isochron::index
