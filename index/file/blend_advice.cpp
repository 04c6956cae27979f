// Leaves steps out, blends them of their neighbors, and compares the surfaces.
#include "index/file/blend_advice.h"

#include "index/file/step_view.h"
#include "index/volume/step_gaps.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

constexpr std::size_t kMostChunks = 64, kMostSampledSteps = 8;
constexpr std::array kQuantiles{0.5, 0.75, 0.9};

/// A place to look at.
struct SampledChunk {
    std::uint32_t step, layer, place;
    double isovalue;
};

double value_at_share(const IndexStats& stats, double share) {
    const auto& bins = stats.histogram;
    const auto total =
        static_cast<double>(std::accumulate(bins.begin(), bins.end(), std::uint64_t{0}));
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < bins.size(); ++bin) {
        below += bins[bin];
        if (static_cast<double>(below) >= share * total)
            return std::lerp(stats.low, stats.high,
                             (static_cast<double>(bin) + 0.5) / static_cast<double>(bins.size()));
    }
    return std::midpoint(stats.low, stats.high);
}

/// At most `most` of some things, spread over all.
template <class T>
std::vector<T> spread(const std::vector<T>& all, std::size_t most) {
    std::vector<T> some;
    for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
        some.push_back(all[all.size() <= most ? i : i * all.size() / most]);
    return some;
}

/// The steps that can be left out: they have others at either side, without a gap between them, as
/// gaps are not blended. Where there are none without a gap, all.
std::vector<std::uint32_t> middle_steps(const SeriesInfo& info) {
    const auto steps = static_cast<std::uint32_t>(info.steps());
    const std::uint32_t beside = steps >= 5 ? 2 : 1;
    std::vector<std::uint32_t> middle(steps - 2 * beside);
    std::iota(middle.begin(), middle.end(), beside);
    std::vector<std::uint32_t> whole = middle;
    for (const std::uint32_t gap : gaps_of(info))
        std::erase_if(
            whole, [&](std::uint32_t step) { return gap + beside >= step && gap < step + beside; });
    return whole.empty() ? middle : whole;
}

std::vector<SampledChunk> sampled(const ChunkStore& store, const IndexStats& stats) {
    const std::vector<std::uint32_t> middle = middle_steps(store.info());
    std::vector<SampledChunk> all;
    for (const std::uint32_t step : spread(middle, kMostSampledSteps))
        for (const double share : kQuantiles) {
            const double isovalue = value_at_share(stats, share);
            const StepView view(store, Instant(step));
            const auto cut = view.cut(isovalue);
            std::vector<SampledChunk> of_step;
            for (std::uint32_t layer = 0; cut && layer < view.chunk_grid().layers(); ++layer) {
                const ChunkLayerPtr table = view.layer(layer);
                for (std::uint32_t place = 0; place < table->low.size(); ++place)
                    if (cut->may_hold(table->low[place], table->high[place]))
                        of_step.push_back({step, layer, place, isovalue});
            }
            for (const SampledChunk& chunk : spread(of_step, kMostChunks))
                all.push_back(chunk);
        }
    return spread(all, kMostChunks);
}

/// A chunk, alone or with those around it.
class ChunkBox {
  public:
    /// @param reach chunks to each side
    ChunkBox(const ChunkGrid& grid, const SampledChunk& at, std::uint32_t reach) : grid_(grid) {
        const auto [x, y] = grid.at(at.place);
        const std::array middle{x, y, at.layer};
        const auto size = grid.size(at.layer, at.place);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            first_[axis] = middle[axis] - std::min(middle[axis], reach);
            end_[axis] = std::min(middle[axis] + reach + 1, grid.counts()[axis]);
            core_[axis] = (middle[axis] - first_[axis]) * kChunkEdge;
            core_end_[axis] = core_[axis] + size[axis] - 1;
        }
        const auto last = grid.size(end_[2] - 1, grid.place(end_[0] - 1, end_[1] - 1));
        for (std::size_t axis = 0; axis < 3; ++axis)
            size_[axis] = (end_[axis] - first_[axis] - 1) * kChunkEdge + last[axis];
    }

    /// Vertices along x, y and z.
    const std::array<std::uint32_t, 3>& size() const { return size_; }
    /// Whether a cell lies in the chunk itself.
    bool in_chunk(const glm::ivec3& cell) const {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (const int at = cell[static_cast<int>(axis)];
                std::cmp_less(at, core_[axis]) || !std::cmp_less(at, core_end_[axis]))
                return false;
        return true;
    }
    /// Scaled values at a step.
    std::vector<double> values(const ChunkStore& store, std::uint32_t step,
                               const std::stop_token& stop) const {
        const StepView view(store, Instant(step));
        std::vector<double> all(std::size_t{size_[0]} * size_[1] * size_[2]);
        for (std::uint32_t z = first_[2]; z < end_[2]; ++z)
            for (std::uint32_t y = first_[1]; y < end_[1]; ++y)
                for (std::uint32_t x = first_[0]; x < end_[0]; ++x) {
                    const std::uint32_t place = grid_.place(x, y);
                    put(view, *view.chunks(z, std::array{place}, stop).front(),
                        {x - first_[0], y - first_[1], z - first_[2]}, all);
                }
        return all;
    }

  private:
    void put(const StepView& view, const Chunk& chunk, const std::array<std::uint32_t, 3>& at,
             std::vector<double>& all) const {
        visit_value_type(view.type(), [&]<class T>(std::type_identity<T>) {
            const auto* values = reinterpret_cast<const T*>(chunk.values.data());
            const auto [nx, ny, nz] = chunk.size;
            for (std::size_t z = 0; z < nz; ++z)
                for (std::size_t y = 0; y < ny; ++y) {
                    const std::size_t row =
                        (at[2] * kChunkEdge + z) * size_[1] + at[1] * kChunkEdge + y;
                    double* const to = all.data() + row * size_[0] + at[0] * kChunkEdge;
                    for (std::size_t x = 0; x < nx; ++x)
                        to[x] = view.scaling()(static_cast<double>(*values++));
                }
        });
    }

    const ChunkGrid& grid_;
    std::array<std::uint32_t, 3> first_{}, end_{}; ///< chunks
    std::array<std::uint32_t, 3> core_{}, core_end_{}, size_{};
};

/// The cells of a box.
class CellsOfBox {
  public:
    explicit CellsOfBox(const ChunkBox& box) : box_(box), size_(box.size()) {}

    std::size_t count() const { return std::size_t{nx()} * ny() * nz(); }
    bool contains(const glm::ivec3& cell) const {
        return cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && std::cmp_less(cell.x, nx()) &&
               std::cmp_less(cell.y, ny()) && std::cmp_less(cell.z, nz());
    }
    std::size_t number(const glm::ivec3& cell) const {
        return (static_cast<std::size_t>(cell.z) * ny() + static_cast<std::size_t>(cell.y)) * nx() +
               static_cast<std::size_t>(cell.x);
    }
    glm::ivec3 place(std::size_t cell) const {
        return {cell % nx(), cell / nx() % ny(), cell / nx() / ny()};
    }
    /// The number of a vertex of a cell. @param corner its bits are steps along x, y and z
    std::size_t vertex(const glm::ivec3& cell, unsigned corner) const {
        const glm::ivec3 at = cell + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        return (static_cast<std::size_t>(at.z) * size_[1] + static_cast<std::size_t>(at.y)) *
                   size_[0] +
               static_cast<std::size_t>(at.x);
    }
    std::vector<bool> active(const std::vector<double>& values, double isovalue) const {
        std::vector<bool> found(count());
        for (std::size_t i = 0; i < found.size(); ++i) {
            const glm::ivec3 cell = place(i);
            int above = 0, below = 0;
            for (unsigned corner = 0; corner < 8; ++corner) {
                const double value = values[vertex(cell, corner)];
                above += value >= isovalue ? 1 : 0;
                below += value < isovalue ? 1 : 0;
            }
            found[i] = above > 0 && below > 0 && above + below == 8;
        }
        return found;
    }
    bool in_chunk(std::size_t cell) const { return box_.in_chunk(place(cell)); }
    /// Calls `f(number)` for the cell itself and its up to 26 neighbors.
    template <class F>
    void around(std::size_t cell, const F& f) const {
        const glm::ivec3 middle = place(cell);
        for (int i = 0; i < 27; ++i)
            if (const glm::ivec3 at = middle + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1;
                contains(at))
                f(number(at));
    }

  private:
    std::uint32_t nx() const { return size_[0] - 1; }
    std::uint32_t ny() const { return size_[1] - 1; }
    std::uint32_t nz() const { return size_[2] - 1; }
    const ChunkBox& box_;
    std::array<std::uint32_t, 3> size_; ///< vertices
};

/// Parts of one surface in the chunk that lie in none of the cells of the other one, nor next to them.
std::uint64_t lone_parts(const CellsOfBox& cells, std::vector<bool> surface,
                         const std::vector<bool>& other) {
    std::uint64_t lone = 0;
    std::vector<std::size_t> part;
    for (std::size_t first = 0; first < surface.size(); ++first) {
        if (!surface[first] || !cells.in_chunk(first))
            continue;
        bool met = false;
        std::size_t in_chunk = 0;
        part = {first};
        surface[first] = false;
        for (std::size_t i = 0; i < part.size(); ++i) {
            in_chunk += cells.in_chunk(part[i]) ? 1 : 0;
            cells.around(part[i], [&](std::size_t near) {
                met = met || other[near];
                if (surface[near]) {
                    surface[near] = false;
                    part.push_back(near);
                }
            });
        }
        lone += !met && in_chunk > BlendQuality::kSmallPart ? 1 : 0;
    }
    return lone;
}
std::uint64_t lone_parts(const CellsOfBox& cells, const std::vector<double>& truth,
                         const std::vector<double>& blend, double isovalue) {
    const auto of_truth = cells.active(truth, isovalue), of_blend = cells.active(blend, isovalue);
    return lone_parts(cells, of_truth, of_blend) + lone_parts(cells, of_blend, of_truth);
}

/// In the blend of the steps beside one, and in the blend that is expected of steps half as far away.
struct LoneParts {
    std::uint64_t second = 0, nearer = 0;
    bool operator==(const LoneParts&) const = default;
};

/// A step in a chunk, and what the blend of two others makes of it.
class LeftOut {
  public:
    /// @param reach chunks to each side that are looked at, too
    LeftOut(const ChunkStore& store, const SampledChunk& at, std::uint32_t reach,
            const std::stop_token& stop)
        : store_(store), at_(at), stop_(stop), box_(store.grid(), at, reach), cells_(box_),
          truth_(box_.values(store, at.step, stop)) {}

    /// @param beside steps to either side
    std::vector<double> blend(std::uint32_t beside) const {
        const std::vector<double>& times = store_.info().times;
        const std::uint32_t before = at_.step - beside, after = at_.step + beside;
        const double share = (times[at_.step] - times[before]) / (times[after] - times[before]);
        std::vector<double> blend = box_.values(store_, before, stop_);
        const std::vector<double> last = box_.values(store_, after, stop_);
        for (std::size_t i = 0; i < blend.size(); ++i)
            blend[i] = std::lerp(blend[i], last[i], share);
        return blend;
    }
    /// Adds how far the blend is off in each active cell.
    void add_distances(const std::vector<double>& blend, std::vector<double>& distances) const {
        for (std::size_t i = 0; i < cells_.count(); ++i) {
            const glm::ivec3 cell = cells_.place(i);
            double off = 0;
            glm::dvec3 slope(0.0);
            int above = 0;
            for (unsigned corner = 0; corner < 8; ++corner) {
                const std::size_t vertex = cells_.vertex(cell, corner);
                const glm::dvec3 d(corner & 1, corner >> 1 & 1, corner >> 2);
                above += truth_[vertex] >= at_.isovalue ? 1 : 0;
                off += (blend[vertex] - truth_[vertex]) / 8;
                slope += (2.0 * d - 1.0) * (truth_[vertex] / 4);
            }
            const double distance = std::abs(off) / glm::length(slope);
            if (above > 0 && above < 8 && std::isfinite(distance))
                distances.push_back(std::min(distance, BlendQuality::kFarthest));
        }
    }
    /// @param fourth none in a series of fewer than five steps
    LoneParts lone(const std::vector<double>& second,
                   const std::optional<std::vector<double>>& fourth) const {
        LoneParts lone{lone_parts(cells_, truth_, second, at_.isovalue), 0};
        lone.nearer = fourth ? lone_parts(cells_, truth_, nearer(second, *fourth), at_.isovalue)
                             : lone.second;
        return lone;
    }
    /// What is expected of the blend of steps half as far away as those of `second`.
    std::vector<double> nearer(const std::vector<double>& second,
                               const std::vector<double>& fourth) const {
        double of_second = 0, of_fourth = 0;
        for (std::size_t i = 0; i < truth_.size(); ++i)
            if (const double near = std::abs(second[i] - truth_[i]),
                far = std::abs(fourth[i] - truth_[i]);
                std::isfinite(near) && std::isfinite(far)) {
                of_second += near;
                of_fourth += far;
            }
        if (of_second == 0)
            return second;
        const double share = share_of_nearer(of_fourth / of_second);
        std::vector<double> blend(second.size());
        for (std::size_t i = 0; i < blend.size(); ++i)
            blend[i] = std::lerp(truth_[i], second[i], share);
        return blend;
    }

  private:
    const ChunkStore& store_;
    const SampledChunk at_;
    const std::stop_token& stop_;
    const ChunkBox box_;
    const CellsOfBox cells_;
    const std::vector<double> truth_;
};

double percentile_95(std::vector<double>& distances) {
    const auto at = distances.begin() +
                    static_cast<std::ptrdiff_t>(static_cast<double>(distances.size() - 1) * 0.95);
    std::nth_element(distances.begin(), at, distances.end());
    return *at;
}

} // namespace

std::optional<BlendQuality> measure_blends(const ChunkStore& store, const IndexStats& stats,
                                           const std::stop_token& stop) {
    const std::size_t steps = store.info().steps();
    if (steps < 3 || !store.carries_values() || !store.has_bricks())
        return std::nullopt;
    BlendQuality quality;
    std::vector<double> of_second, of_fourth;
    for (const SampledChunk& chunk : sampled(store, stats)) {
        stop_if_asked(stop);
        const LeftOut step(store, chunk, 0, stop);
        const std::vector<double> second = step.blend(1);
        step.add_distances(second, of_second);
        std::optional<std::vector<double>> fourth;
        if (steps >= 5) {
            fourth = step.blend(2);
            step.add_distances(*fourth, of_fourth);
        }
        LoneParts lone = step.lone(second, fourth);
        if (lone != LoneParts{}) { // what they belong to may lie in the next chunk
            const LeftOut wide(store, chunk, 1, stop);
            lone = wide.lone(wide.blend(1), fourth ? std::optional(wide.blend(2)) : std::nullopt);
        }
        quality.lone_second += lone.second;
        quality.lone += lone.nearer;
    }
    if (of_second.empty())
        return std::nullopt;
    quality.cells = of_second.size();
    quality.every_second = percentile_95(of_second);
    if (!of_fourth.empty())
        quality.every_fourth = percentile_95(of_fourth);
    return quality;
}

std::optional<BlendQuality> blend_quality(const IndexFile& file, const std::stop_token& stop) {
    const std::optional<BlendQuality>& kept = file.metadata().blends;
    return kept ? kept : measure_blends(file.chunks(), file.stats(), stop);
}

} // namespace isochron::index
