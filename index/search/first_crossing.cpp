// Finds when each cell is first active.
#include "index/search/first_crossing.h"

#include "index/error.h"
#include "index/search/step_slab.h"
#include "index/surface/cell_colors.h"
#include "index/system/parallel.h"
#include "index/volume/blend.h"
#include "index/volume/instant_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace isochron::index {
namespace {

/// The first n, 1 to N, at which the blend of a vertex is on the side on which it is at N.
/// @param a, b finite, on two sides
std::uint32_t flip_of(double a, double b, double isovalue) {
    constexpr std::uint32_t kWhole = Instant::kFractions;
    const auto flipped = [&](std::uint32_t n) {
        return (blended(a, b, n) >= isovalue) == (b >= isovalue);
    };
    // Halves keep the differences finite.
    const double share = (isovalue / 2 - a / 2) / (b / 2 - a / 2) * kWhole;
    std::uint32_t low = 0, high = kWhole; // not flipped yet; flipped
    if (share >= 2 && share <= kWhole - 2) {
        const auto near = static_cast<std::uint32_t>(share);
        for (const std::uint32_t n : {near, near + 1, near - 1})
            if (n > low && n < high)
                (flipped(n) ? high : low) = n;
    }
    while (high - low > 1) {
        const std::uint32_t middle = (low + high) / 2;
        (flipped(middle) ? high : low) = middle;
    }
    return high;
}

/// The vertices of a chunk's cells at two steps, as bits of rows: on which side they are.
class VerticesOfTwoSteps {
  public:
    static constexpr std::size_t kEdge = kChunkEdge + 1;

    /// @param now, next scaled values of a vertex of the chunk @param cells along each axis
    template <class Now, class Next>
    void look(const std::array<std::uint32_t, 3>& cells, double isovalue, const Now& now,
              const Next& next) {
        for (std::uint32_t z = 0; z <= cells[2]; ++z)
            for (std::uint32_t y = 0; y <= cells[1]; ++y) {
                std::uint32_t above_now = 0, above_next = 0, missing = 0;
                for (std::uint32_t x = 0; x <= cells[0]; ++x) {
                    const double a = now(x, y, z), b = next(x, y, z);
                    above_now |= (a >= isovalue ? 1u : 0u) << x;
                    above_next |= (b >= isovalue ? 1u : 0u) << x;
                    missing |= (std::isfinite(a) && std::isfinite(b) ? 0u : 1u) << x;
                }
                rows_[z][y] = {above_now, above_next, missing};
            }
    }
    /// The cells of a row, as bits, that have all vertices at both steps and are active at some time
    /// after the first step, but not there.
    std::uint32_t flipping(std::uint32_t y, std::uint32_t z) const {
        const std::array<const Row*, 4> around{&rows_[z][y], &rows_[z][y + 1], &rows_[z + 1][y],
                                               &rows_[z + 1][y + 1]};
        Row any{}, all{~0u, ~0u, ~0u};
        for (const Row* row : around)
            for (std::size_t i = 0; i < row->size(); ++i) {
                any[i] |= (*row)[i];
                all[i] &= (*row)[i];
            }
        for (std::size_t i = 0; i < any.size(); ++i) {
            any[i] |= any[i] >> 1;
            all[i] &= all[i] >> 1;
        }
        return ~any[2] & ((all[0] & ~all[1]) | (~any[0] & any[1]));
    }

  private:
    using Row = std::array<std::uint32_t, 3>; ///< above at the first step, at the next; missing
    std::array<std::array<Row, kEdge>, kEdge> rows_{};
};

/// Finds the crossings between two steps, layer by layer of chunks.
class BlendedCrossings {
  public:
    BlendedCrossings(std::shared_ptr<const IndexFile> file, std::size_t level, double isovalue,
                     std::stop_token stop)
        : file_(std::move(file)), level_(level), isovalue_(isovalue), stop_(std::move(stop)) {}

    bool operator()(std::uint32_t step, FirstCrossings& found) const {
        if (!std::isfinite(isovalue_))
            return true;
        const StepView now = view(step), next = view(step + 1);
        try {
            if (!now.by_chunks()) { // before there are several threads
                now.whole(stop_);
                next.whole(stop_);
            }
            const std::uint32_t layers = StepSlab::layers(now.grid());
            const unsigned threads = std::min(layers, thread_count(0));
            std::vector<std::array<StepSlab, 2>> slabs(threads);
            parallel_for(layers, threads,
                         [&](std::size_t layer, unsigned worker) {
                             work_on(now, next, static_cast<std::uint32_t>(layer), slabs[worker],
                                     found);
                         },
                         {});
        } catch (const Stopped&) {
            return false;
        }
        return !stop_.stop_requested();
    }

  private:
    StepView view(std::uint32_t step) const {
        return level_ == 0 && file_->referral() ? part_of_step(*file_, Instant(step))
                                                : step_in_chunks(*file_, Instant(step), level_);
    }

    /// Whether cells of a chunk of the layer may be active between the steps, by place.
    std::vector<bool> candidates(const StepView& now, const StepView& next,
                                 std::uint32_t layer) const {
        const ChunkStore& store = now.store();
        std::vector<bool> may(store.grid().chunks_of_layer(), true);
        if (!now.by_chunks() || !store.has_bricks())
            return may;
        const auto cut = now.cut(isovalue_), next_cut = next.cut(isovalue_);
        if (!cut && !next_cut && now.levels() == next.levels()) // all values are on one side
            may.assign(may.size(), false);
        if (!cut || !next_cut)
            return may;
        const ChunkLayerPtr table = store.layer(now.at().step, layer),
                            next_table = store.layer(next.at().step, layer);
        const auto is_below = [](const LevelMap::Cut& of, std::uint8_t low) {
            return low + (of.exact ? 1 : 0) <= of.threshold;
        };
        for (std::size_t i = 0; i < may.size(); ++i)
            may[i] =
                (is_below(*cut, table->low[i]) || is_below(*next_cut, next_table->low[i])) &&
                (table->high[i] >= cut->threshold || next_table->high[i] >= next_cut->threshold);
        return may;
    }

    void work_on(const StepView& now, const StepView& next, std::uint32_t layer,
                 std::array<StepSlab, 2>& slabs, FirstCrossings& found) const {
        stop_if_asked(stop_);
        const std::vector<bool> may = candidates(now, next, layer);
        if (!now.by_chunks())
            return cross_layer(now.whole(stop_).values, next.whole(stop_).values, 0, layer, may,
                               now, found);
        for (std::size_t i = 0; i < slabs.size(); ++i) {
            slabs[i].begin(i == 0 ? now : next, layer, stop_);
            slabs[i].fill_around(corners_of(may, slabs[i], now, layer), false);
        }
        cross_layer(slabs[0].around(), slabs[1].around(), slabs[0].first_plane(), layer, may, now,
                    found);
    }

    /// The cells of a chunk along each axis.
    static std::array<std::uint32_t, 3> cells_of(const Grid& grid,
                                                 const std::array<std::uint32_t, 3>& chunk) {
        std::array<std::uint32_t, 3> cells{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t first = chunk[axis] * kChunkEdge, all = grid.cells()[axis];
            cells[axis] = first < all ? std::min(kChunkEdge, all - first) : 0;
        }
        return cells;
    }

    /// The cells at the corners of the candidates, ascending: what they need all cells need.
    static std::vector<CellId> corners_of(const std::vector<bool>& may, const StepSlab& slab,
                                          const StepView& step, std::uint32_t layer) {
        const Grid& grid = step.grid();
        const ChunkGrid& chunks = step.chunk_grid();
        const auto [width, height, depth] = grid.cells();
        const auto ends = [](std::uint32_t chunk, std::uint32_t all) {
            const std::uint32_t first = chunk * kChunkEdge;
            std::vector<std::uint32_t> both;
            if (first < all)
                both.push_back(first);
            if (const std::uint32_t last = std::min(first + kChunkEdge, all) - 1;
                first < all && last > first)
                both.push_back(last);
            return both;
        };
        std::vector<CellId> ids;
        for (const std::uint32_t z : ends(layer, depth))
            for (std::uint32_t cy = 0; cy < chunks.counts()[1]; ++cy)
                for (const std::uint32_t y : ends(cy, height))
                    for (std::uint32_t cx = 0; cx < chunks.counts()[0]; ++cx) {
                        if (!may[chunks.place(cx, cy)])
                            continue;
                        for (const std::uint32_t x : ends(cx, width))
                            ids.push_back((CellId{z - slab.first_plane()} * height + y) * width +
                                          x);
                    }
        return ids;
    }

    /// @param first_plane z of plane 0 of the values
    void cross_layer(const StepValues& now, const StepValues& next, std::uint32_t first_plane,
                     std::uint32_t layer, const std::vector<bool>& may, const StepView& step,
                     FirstCrossings& found) const {
        visit_value_type(now.type, [&]<class T>(std::type_identity<T>) {
            const T* const a = now.step<T>(step.at().step).data();
            const T* const b = next.step<T>(step.at().step + 1).data();
            for (std::uint32_t place = 0; place < may.size(); ++place)
                if (may[place]) {
                    const auto [x, y] = step.chunk_grid().at(place);
                    cross_chunk(a, b, now.scaling, step.at(), first_plane, {x, y, layer},
                                step.grid(), found);
                }
        });
    }

    template <class T>
    void cross_chunk(const T* now, const T* next, const Scaling& scaling, Instant at,
                     std::uint32_t first_plane, const std::array<std::uint32_t, 3>& chunk,
                     const Grid& grid, FirstCrossings& found) const {
        const std::array<std::uint32_t, 3> cells = cells_of(grid, chunk);
        if (cells[0] == 0 || cells[1] == 0 || cells[2] == 0)
            return;
        const std::size_t row = grid.vertices[0], plane = row * grid.vertices[1];
        const std::size_t first = (std::size_t{chunk[2]} * kChunkEdge - first_plane) * plane +
                                  chunk[1] * kChunkEdge * row + chunk[0] * kChunkEdge;
        const auto value = [&](const T* of, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
            return scaling(static_cast<double>(of[first + z * plane + y * row + x]));
        };
        VerticesOfTwoSteps sides;
        sides.look(
            cells, isovalue_, [&](auto x, auto y, auto z) { return value(now, x, y, z); },
            [&](auto x, auto y, auto z) { return value(next, x, y, z); });
        const auto [width, height, depth] = grid.cells();
        for (std::uint32_t z = 0; z < cells[2]; ++z)
            for (std::uint32_t y = 0; y < cells[1]; ++y) {
                std::uint32_t bits = sides.flipping(y, z) & ((1u << cells[0]) - 1);
                for (; bits; bits &= bits - 1) {
                    const auto x = static_cast<std::uint32_t>(std::countr_zero(bits));
                    const CellId id =
                        ((CellId{chunk[2]} * kChunkEdge + z) * height + chunk[1] * kChunkEdge + y) *
                            width +
                        chunk[0] * kChunkEdge + x;
                    cross(
                        found, at, id,
                        [&](const T* of, unsigned corner) {
                            return value(of, x + (corner & 1), y + (corner >> 1 & 1),
                                         z + (corner >> 2));
                        },
                        now, next);
                }
            }
    }

    /// A cell all of whose vertices are on one side at first is active as soon as one of them is on
    /// the other side, until the last one is, too.
    template <class T, class Value>
    void cross(FirstCrossings& found, Instant at, CellId id, const Value& value, const T* now,
               const T* next) const {
        std::uint32_t first = Instant::kFractions, last = 0;
        unsigned flips = 0;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const double a = value(now, corner), b = value(next, corner);
            if ((a >= isovalue_) == (b >= isovalue_))
                continue;
            const std::uint32_t flip = flip_of(a, b, isovalue_);
            first = std::min(first, flip);
            last = std::max(last, flip);
            ++flips;
        }
        if (first == Instant::kFractions || (flips == 8 && first == last))
            return;
        found.steps[id] = static_cast<std::uint16_t>(at.step);
        found.fractions[id] = static_cast<std::uint16_t>(first);
    }

    std::shared_ptr<const IndexFile> file_;
    std::size_t level_;
    double isovalue_;
    std::stop_token stop_;
};

} // namespace

CrossingsBetween crossings_between(std::shared_ptr<const IndexFile> file, std::size_t level,
                                   double isovalue, std::stop_token stop) {
    return BlendedCrossings(std::move(file), level, isovalue, std::move(stop));
}

FirstCrossingsPtr first_crossings(const SeriesInfo& info, const Search& search, double isovalue,
                                  const std::stop_token& stop, const CrossingsBetween& between) {
    if (info.steps() >= FirstCrossings::kNever)
        throw Error("first crossings of {} steps: expected fewer than {}", info.steps(),
                    FirstCrossings::kNever);
    auto found = std::make_shared<FirstCrossings>();
    found->isovalue = isovalue;
    found->steps.assign(info.grid.cell_count(), FirstCrossings::kNever);
    if (between)
        found->fractions.assign(found->steps.size(), 0);
    // Backwards, so that the earliest step is written last and no comparison is needed.
    for (auto step = static_cast<std::uint32_t>(info.steps()); step-- > 0;) {
        if (between && step + 1 < info.steps() && !between(step, *found))
            return nullptr;
        const CellSetPtr set = search({Instant(step), isovalue}, stop);
        if (!set)
            return nullptr;
        for (const CellId id : set->ids) {
            found->steps[id] = static_cast<std::uint16_t>(step);
            if (between)
                found->fractions[id] = 0;
        }
    }
    return found;
}

void color_by_first_crossing(const FirstCrossings& crossings, const std::vector<double>& times,
                             Instant at, std::span<const CellId> cells,
                             std::span<std::uint16_t> out) {
    at = at.within(times.size());
    const std::uint16_t now = color_coordinate(time_at(times, at), times.front(), times.back());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::uint16_t step = crossings.steps[cells[i]];
        if (crossings.blended() && step != FirstCrossings::kNever) {
            const Instant first(step, crossings.fractions[cells[i]]);
            out[i] = color_coordinate(time_at(times, first), times.front(), times.back());
            continue;
        }
        if (at.between() && (step == FirstCrossings::kNever || step > at.step))
            out[i] = now; // the surface has reached it since the last step
        else
            out[i] = step == FirstCrossings::kNever
                         ? kNoColor
                         : color_coordinate(times[step], times.front(), times.back());
    }
}

} // namespace isochron::index
