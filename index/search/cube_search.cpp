// Finds cells chunk by chunk, and writes them in the order of the layer by counting.
#include "index/search/cube_search.h"

#include "index/search/chunk_reach.h"
#include "index/search/cube_shading.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace isochron::index {
namespace {

using Clock = std::chrono::steady_clock;

} // namespace

void CubeSearch::search(const StepView& step, const LayerCandidates& candidates, const Query& query,
                        std::uint64_t cut, bool shaded, const std::stop_token& stop, CellSet& out,
                        std::chrono::nanoseconds& shading, const StayingCells* staying) {
    step_ = &step;
    staying_ = staying;
    chunks_ = &step.chunk_grid();
    shading_ = std::chrono::nanoseconds(0);
    find(candidates, query, cut, shaded, stop, out);
    const auto found = Clock::now();
    if (shaded)
        shade_others(candidates, query, stop);
    std::ranges::sort(found_, {}, [](const Found& it) { return std::tuple(it.y, it.x); });
    write(shaded, out);
    held_.clear();
    shading = shaded ? shading_ + (Clock::now() - found) : shading_;
}

/// Finds the chunks with active cells, and the cells as bits. Shades the cells whose neighborhood
/// has been read, while their values are in the nearest cache.
void CubeSearch::find(const LayerCandidates& candidates, const Query& query, std::uint64_t cut,
                      bool shaded, const std::stop_token& stop, CellSet& out) {
    layer_ = candidates.layer();
    for (auto& layer : there_)
        layer.assign(chunks_->chunks_of_layer(), nullptr);
    for (auto& layer : missing_) // what a search that failed has left
        layer.clear();
    held_.clear();
    found_.clear();
    places_.clear();
    const std::vector<std::uint32_t>& places = candidates.places();
    for (std::size_t i = 0; i < places.size(); ++i)
        there_[1][places[i]] = candidates.chunk(i).get();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto [x, y] = chunks_->at(places[i]);
        need(x, y, candidates.reach(i));
    }
    fetch(candidates, stop);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (candidates.bricks(i) == 0)
            continue;
        stop_if_asked(stop);
        const auto [x, y] = chunks_->at(places[i]);
        const ChunksAround reach = candidates.reach(i);
        cube_.begin(*step_, {x, y, layer_});
        fill_cube(x, y, reach);
        out.candidates += cells_of_bricks(candidates.bricks(i), cube_.cells());
        CubeRows rows = active_rows(cube_, cut, candidates.bricks(i));
        if (staying_)
            keep_sides(staying_->others(layer_, places[i]), rows);
        const SidesOfCells sides = sides_of(rows);
        if (sides == 0)
            continue;
        Found& found = found_.emplace_back(x, y, rows, chunks_around(sides, true), 0, 0);
        if (!shaded) {
            take_places(found);
        } else if (are_there(x, y, found.around)) {
            const auto started = Clock::now();
            fill_cube(x, y, found.around & ~reach);
            shade(found, query);
            shading_ += Clock::now() - started;
        }
    }
}

/// Shades the found chunks around which something was missing.
void CubeSearch::shade_others(const LayerCandidates& candidates, const Query& query,
                              const std::stop_token& stop) {
    for (const Found& found : found_)
        need(found.x, found.y, found.around);
    fetch(candidates, stop);
    for (Found& found : found_) {
        if (found.count > 0)
            continue;
        stop_if_asked(stop);
        cube_.begin(*step_, {found.x, found.y, layer_});
        fill_cube(found.x, found.y, found.around);
        shade(found, query);
    }
}

/// Makes the planes of the cells of a chunk, which the cube holds.
void CubeSearch::shade(Found& found, const Query& query) {
    take_places(found);
    planes_.resize(std::max(planes_.size(), places_.size()));
    shade_cube(cube_, query, std::span(places_).subspan(found.first),
               std::span(planes_).subspan(found.first, found.count));
}

void CubeSearch::take_places(Found& found) {
    found.first = places_.size();
    found.count = append_places(found.rows, places_);
}

/// Writes the found cells in the order of the layer: first counts the cells of each row.
void CubeSearch::write(bool shaded, CellSet& out) {
    next_.clear();
    for (std::size_t i = 0; i < found_.size(); ++i) {
        if (i == 0 || found_[i].y != found_[i - 1].y)
            next_.emplace_back();
        add_counts(found_[i].rows, next_.back());
    }
    const auto [width, height, depth] = step_->grid().cells();
    std::uint32_t sum = 0;
    for (std::uint32_t z = 0; z < kChunkEdge; ++z)
        for (std::size_t i = 0, group = 0; i < found_.size(); ++group) {
            const std::uint32_t first_y = found_[i].y * kChunkEdge;
            for (std::uint32_t y = 0; y < kChunkEdge; ++y) {
                std::uint32_t& next = next_[group][z * kChunkEdge + y];
                if (next > 0 && shaded)
                    out.rows.push_back({static_cast<std::uint16_t>(first_y + y),
                                        static_cast<std::uint16_t>(layer_ * kChunkEdge + z), sum});
                sum += std::exchange(next, sum);
            }
            for (const std::uint32_t y = found_[i].y; i < found_.size() && found_[i].y == y;)
                ++i;
        }
    out.ids.resize(sum);
    out.points.resize(shaded ? sum : 0);
    std::size_t group = 0;
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const Found& found = found_[i];
        group += i > 0 && found.y != found_[i - 1].y ? 1 : 0;
        RowCounts& next = next_[group];
        const std::uint32_t x0 = found.x * kChunkEdge, y0 = found.y * kChunkEdge,
                            z0 = layer_ * kChunkEdge;
        const CellId first = (z0 * height + y0) * width + x0; // wraps in wide grids, as ids do
        for (std::size_t k = found.first; k < found.first + found.count; ++k) {
            const std::uint32_t x = places_[k] % kChunkEdge, row = places_[k] / kChunkEdge,
                                y = row % kChunkEdge, z = row / kChunkEdge;
            const std::uint32_t at = next[row]++;
            out.ids[at] = first + (z * height + y) * width + x;
            if (shaded)
                out.points[at] = {static_cast<std::uint16_t>(x0 + x),
                                  static_cast<std::uint16_t>(y0 + y),
                                  static_cast<std::uint16_t>(z0 + z), 0, planes_[k]};
        }
    }
}

/// Notes which chunks around a chunk are to be fetched.
void CubeSearch::need(std::uint32_t x, std::uint32_t y, ChunksAround around) {
    static const Chunk expected; // stands for a chunk until it has been read
    for_each_around(around, {x, y, layer_}, *chunks_,
                    [&](unsigned, std::uint32_t cx, std::uint32_t cy, std::uint32_t layer) {
                        const std::size_t i = layer + 1 - layer_;
                        const std::uint32_t place = chunks_->place(cx, cy);
                        if (there_[i][place])
                            return;
                        there_[i][place] = &expected;
                        missing_[i].push_back(place);
                    });
}

/// Reads the chunks that are needed and not there.
void CubeSearch::fetch(const LayerCandidates& candidates, const std::stop_token& stop) {
    for (std::vector<std::uint32_t>& places : missing_)
        std::ranges::sort(places);
    auto others = missing_;
    for (std::uint32_t i = 0; i < others.size(); ++i)
        candidates.keep_unannounced(layer_ + i - 1, others[i]);
    step_->expect(layer_ - 1, others); // all of them before waiting for any
    for (std::uint32_t i = 0; i < missing_.size(); ++i) {
        const std::vector<std::uint32_t> places = std::exchange(missing_[i], {});
        if (places.empty())
            continue;
        std::vector<ChunkPtr> chunks = step_->cube_chunks(layer_ + i - 1, places, stop);
        for (std::size_t at = 0; at < places.size(); ++at) {
            there_[i][places[at]] = chunks[at].get();
            held_.push_back(std::move(chunks[at]));
        }
    }
}

bool CubeSearch::are_there(std::uint32_t x, std::uint32_t y, ChunksAround around) const {
    bool all = true;
    for_each_around(around, {x, y, layer_}, *chunks_,
                    [&](unsigned, std::uint32_t cx, std::uint32_t cy, std::uint32_t layer) {
                        all &= there_[layer + 1 - layer_][chunks_->place(cx, cy)] != nullptr;
                    });
    return all;
}

/// Copies the parts of the chunks around that lie in the cube.
void CubeSearch::fill_cube(std::uint32_t x, std::uint32_t y, ChunksAround around) {
    for_each_around(around, {x, y, layer_}, *chunks_,
                    [&](unsigned bit, std::uint32_t cx, std::uint32_t cy, std::uint32_t layer) {
                        cube_.copy(bit, *there_[layer + 1 - layer_][chunks_->place(cx, cy)]);
                    });
}

} // namespace isochron::index
