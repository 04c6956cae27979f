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

/// Scaled values of one chunk at a step.
std::vector<double> values_of(const ChunkStore& store, std::uint32_t step, const SampledChunk& at,
                              const std::stop_token& stop) {
    const StepView view(store, Instant(step));
    const ChunkPtr chunk = view.chunks(at.layer, std::array{at.place}, stop).front();
    return visit_value_type(view.type(), [&]<class T>(std::type_identity<T>) {
        const auto* values = reinterpret_cast<const T*>(chunk->values.data());
        std::vector<double> scaled(chunk->values.size() / sizeof(T));
        for (std::size_t i = 0; i < scaled.size(); ++i)
            scaled[i] = view.scaling()(static_cast<double>(values[i]));
        return scaled;
    });
}

/// The cells of a chunk.
class CellsOfChunk {
  public:
    CellsOfChunk(const ChunkStore& store, const SampledChunk& at)
        : size_(store.grid().size(at.layer, at.place)) {}

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
    std::array<std::uint32_t, 3> size_; ///< vertices
};

/// Parts of one surface that lie in none of the cells of the other one, nor next to them.
std::uint64_t lone_parts(const CellsOfChunk& cells, std::vector<bool> surface,
                         const std::vector<bool>& other) {
    std::uint64_t lone = 0;
    std::vector<std::size_t> part;
    for (std::size_t first = 0; first < surface.size(); ++first) {
        if (!surface[first])
            continue;
        bool met = false;
        part = {first};
        surface[first] = false;
        for (std::size_t i = 0; i < part.size(); ++i)
            cells.around(part[i], [&](std::size_t near) {
                met = met || other[near];
                if (surface[near]) {
                    surface[near] = false;
                    part.push_back(near);
                }
            });
        lone += !met && part.size() > BlendQuality::kSmallPart ? 1 : 0;
    }
    return lone;
}
std::uint64_t lone_parts(const CellsOfChunk& cells, const std::vector<double>& truth,
                         const std::vector<double>& blend, double isovalue) {
    const auto of_truth = cells.active(truth, isovalue), of_blend = cells.active(blend, isovalue);
    return lone_parts(cells, of_truth, of_blend) + lone_parts(cells, of_blend, of_truth);
}

/// A step in a chunk, and what the blend of two others makes of it.
class LeftOut {
  public:
    LeftOut(const ChunkStore& store, const SampledChunk& at, const std::stop_token& stop)
        : store_(store), at_(at), stop_(stop), cells_(store, at),
          truth_(values_of(store, at.step, at, stop)) {}

    /// @param beside steps to either side
    std::vector<double> blend(std::uint32_t beside) const {
        const std::vector<double>& times = store_.info().times;
        const std::uint32_t before = at_.step - beside, after = at_.step + beside;
        const double share = (times[at_.step] - times[before]) / (times[after] - times[before]);
        std::vector<double> blend = values_of(store_, before, at_, stop_);
        const std::vector<double> last = values_of(store_, after, at_, stop_);
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
    std::uint64_t lone(const std::vector<double>& blend) const {
        return lone_parts(cells_, truth_, blend, at_.isovalue);
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
    const CellsOfChunk cells_;
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
        const LeftOut step(store, chunk, stop);
        const std::vector<double> second = step.blend(1);
        step.add_distances(second, of_second);
        quality.lone_second += step.lone(second);
        if (steps < 5) {
            quality.lone = quality.lone_second;
            continue;
        }
        const std::vector<double> fourth = step.blend(2);
        step.add_distances(fourth, of_fourth);
        quality.lone += step.lone(step.nearer(second, fourth));
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
