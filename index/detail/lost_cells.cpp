// Finds active cells where a coarser level draws none.
#include "index/detail/lost_cells.h"

#include "index/detail/cell_thinning.h"

#include <algorithm>
#include <array>
#include <optional>

namespace isochron::index {
namespace {

using Place = std::array<std::uint32_t, 3>;

Place place_of(const CellPoint& point) {
    return {point.x, point.y, point.z};
}

/// The lowest vertex along an axis of a cell at a place of mixed levels.
constexpr std::uint32_t low_vertex(std::uint32_t doubled) {
    return (doubled - (1u << level_of_center(doubled))) / 2;
}

/// The cells of a level that hold drawn ones: a bit for each, rows begin with a new word.
class HoldsDrawn {
  public:
    HoldsDrawn(const Grid& volume, unsigned level) : level_(level) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            size_[axis] = ((volume.cells()[axis] - 1) >> level) + 1;
        words_ = (size_[0] + 63) / 64;
        bits_.resize(words_ * size_[1] * size_[2]);
    }

    /// @param point at a place of mixed levels
    void add(const CellPoint& point) {
        Place low{}, high{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t at = place_of(point)[axis], first = low_vertex(at);
            low[axis] = first >> level_;
            high[axis] =
                std::min((first + (1u << level_of_center(at)) - 1) >> level_, size_[axis] - 1);
        }
        for (std::uint32_t z = low[2]; z <= high[2]; ++z)
            for (std::uint32_t y = low[1]; y <= high[1]; ++y)
                for (std::uint32_t x = low[0]; x <= high[0]; ++x)
                    row(y, z)[x / 64] |= std::uint64_t{1} << x % 64;
    }

    bool at(const Place& cell) const {
        return bits_[(std::size_t{cell[2]} * size_[1] + cell[1]) * words_ + cell[0] / 64] >>
                   cell[0] % 64 &
               1;
    }

    /// Which of the cells that hold some of the volume's cells hold drawn ones.
    enum class Share : std::uint8_t { none, some, all };
    /// @param low, high the first and the last of the volume's cells
    Share share(const Place& low, const Place& high) const {
        bool any = false, every = true;
        Place last{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            last[axis] = std::min(high[axis] >> level_, size_[axis] - 1);
        for (std::uint32_t z = low[2] >> level_; z <= last[2]; ++z)
            for (std::uint32_t y = low[1] >> level_; y <= last[1]; ++y)
                for (std::uint32_t x = low[0] >> level_; x <= last[0]; ++x) {
                    const bool holds = at({x, y, z});
                    any |= holds;
                    every &= holds;
                }
        return every ? Share::all : any ? Share::some : Share::none;
    }

  private:
    std::uint64_t* row(std::uint32_t y, std::uint32_t z) {
        return &bits_[(std::size_t{z} * size_[1] + y) * words_];
    }

    unsigned level_;
    Place size_{};
    std::size_t words_ = 0; ///< words of a row
    std::vector<std::uint64_t> bits_;
};

} // namespace

bool LostCells::find(const Query& query, std::span<const CellPoint> drawn,
                     std::span<const std::uint8_t> levels, CellSet& found,
                     const std::stop_token& stop) {
    found = {};
    found.query = query;
    const StepView step = step_in_chunks(file_, query.instant, finest_);
    const auto cut = step.cut(query.isovalue);
    if (!cut)
        return true;
    std::vector<std::optional<HoldsDrawn>> drawn_in(std::ranges::max(levels) + 1u);
    for (const std::uint8_t level : levels)
        if (level > finest_ && !drawn_in[level]) {
            drawn_in[level].emplace(file_.info().grid, level);
            for (const CellPoint& point : drawn)
                drawn_in[level]->add(point);
        }
    const auto level_at = [&](const Place& cell) { // a cell of the finest level
        return levels[regions_.number({regions_.along(0, cell[0], finest_),
                                       regions_.along(1, cell[1], finest_),
                                       regions_.along(2, cell[2], finest_)})];
    };

    const ChunkGrid& chunks = step.chunk_grid();
    const auto cells = file_.info().grid.cells();
    using Share = HoldsDrawn::Share;
    const auto share = [&](std::uint32_t layer, std::uint32_t place) {
        const auto [x, y] = chunks.at(place);
        const Place first{x * kChunkEdge, y * kChunkEdge, layer * kChunkEdge};
        const unsigned level = level_at(first);
        Place low{}, high{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = first[axis] << finest_;
            high[axis] = ((first[axis] + kChunkEdge) << finest_) - 1;
            if (low[axis] >= cells[axis]) // it holds no cells
                return Share::all;
        }
        return level > finest_ ? drawn_in[level]->share(low, high) : Share::all;
    };
    const auto count = [&](const ChunkFilter& only) {
        std::size_t all = 0;
        for (std::uint32_t layer = 0; layer < chunks.layers(); ++layer)
            all += LayerCandidates::places_of(*step.layer(layer), *cut, layer, only).size();
        return all;
    };
    ChunkFilter only = [&](std::uint32_t layer, std::uint32_t place) {
        return share(layer, place) != Share::all;
    };
    const ChunkFilter wholly = [&](std::uint32_t layer, std::uint32_t place) {
        return share(layer, place) == Share::none;
    };
    if (count(only) > most_chunks_)
        only = wholly;
    const CellThinning thinning(count(only), most_chunks_);
    const ChunkFilter read = [&](std::uint32_t layer, std::uint32_t place) {
        const auto [x, y] = chunks.at(place);
        return thinning.keeps({x, y, layer}) && only(layer, place);
    };
    if (!search_.search(step, found, true, true, stop, thinning.keeps_all() ? only : read))
        return false;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < found.points.size(); ++i) {
        const Place cell = place_of(found.points[i]);
        const unsigned level = level_at(cell);
        if (level <= finest_)
            continue;
        const unsigned down = level - finest_;
        if (drawn_in[level]->at({cell[0] >> down, cell[1] >> down, cell[2] >> down}))
            continue;
        found.ids[kept] = found.ids[i];
        found.points[kept++] = found.points[i];
    }
    found.ids.resize(kept);
    found.points.resize(kept);
    found.rows.clear(); // they are those of all
    return true;
}

} // namespace isochron::index
