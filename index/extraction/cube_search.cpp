// Finds cells chunk by chunk, and writes them in the order of the layer by counting.
#include "index/extraction/cube_search.h"

#include "index/extraction/chunk_reach.h"
#include "index/extraction/cube_shading.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace isochron::index {
namespace {

/// The chunks at offsets of 0 and 1, given as LayerCandidates::reach does.
ChunksAround around_of(unsigned reach) {
    ChunksAround around = 0;
    for (unsigned d = 0; d < 8; ++d)
        around |= (reach >> d & 1u) << (kOwnChunk + (d & 1) + 3 * (d >> 1 & 1) + 9 * (d >> 2));
    return around;
}

void stop_if_asked(const std::stop_token& stop) {
    if (stop.stop_requested())
        throw Stopped();
}

} // namespace

CubeSearch::CubeSearch(const ChunkStore& store)
    : store_(store), chunks_(store.grid()), cube_(store.info()) {
    for (auto& layer : there_)
        layer.resize(chunks_.chunks_of_layer());
}

void CubeSearch::search(const LayerCandidates& candidates, const Query& query, std::uint64_t cut,
                        bool shaded, const std::stop_token& stop, CellSet& out,
                        std::chrono::nanoseconds& shading) {
    find(candidates, query, cut, stop, out);
    const auto found = std::chrono::steady_clock::now();
    if (shaded)
        shade(candidates, query, stop);
    else
        for (Found& it : found_)
            take_places(it);
    write(shaded, out);
    shading = shaded ? std::chrono::steady_clock::now() - found : std::chrono::nanoseconds(0);
}

void CubeSearch::take_places(Found& found) {
    found.first = places_.size();
    found.count = append_places(found.rows, places_);
}

/// Finds the chunks with active cells, and the cells as bits.
void CubeSearch::find(const LayerCandidates& candidates, const Query& query, std::uint64_t cut,
                      const std::stop_token& stop, CellSet& out) {
    layer_ = candidates.layer();
    for (auto& layer : there_)
        std::ranges::fill(layer, nullptr);
    held_.clear();
    found_.clear();
    places_.clear();
    const std::vector<std::uint32_t>& places = candidates.places();
    for (std::size_t i = 0; i < places.size(); ++i)
        there_[1][places[i]] = candidates.chunk(i).get();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto [x, y] = chunks_.at(places[i]);
        for_each_around(around_of(candidates.reach(i)), {x, y, layer_}, chunks_,
                        [&](auto, std::uint32_t cx, std::uint32_t cy, std::uint32_t layer) {
                            need(cx, cy, layer);
                        });
    }
    fetch(candidates, query.step, stop);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (candidates.bricks(i) == 0)
            continue;
        stop_if_asked(stop);
        const auto [x, y] = chunks_.at(places[i]);
        fill_cube(query.step, x, y, around_of(candidates.reach(i)));
        out.candidates += cells_of_bricks(candidates.bricks(i), cube_.cells());
        const CubeRows rows = active_rows(cube_, cut, candidates.bricks(i));
        if (std::ranges::any_of(rows, [](std::uint16_t row) { return row != 0; }))
            found_.push_back({x, y, rows, 0, 0});
    }
    std::ranges::sort(found_, {}, [](const Found& it) { return std::tuple(it.y, it.x); });
}

/// Makes the planes of the found cells.
void CubeSearch::shade(const LayerCandidates& candidates, const Query& query,
                       const std::stop_token& stop) {
    for (const Found& found : found_)
        for_each_around(chunks_around(sides_of(found.rows), true), {found.x, found.y, layer_},
                        chunks_, [&](auto, std::uint32_t x, std::uint32_t y, std::uint32_t layer) {
                            need(x, y, layer);
                        });
    fetch(candidates, query.step, stop);
    for (Found& found : found_) {
        stop_if_asked(stop);
        fill_cube(query.step, found.x, found.y, chunks_around(sides_of(found.rows), true));
        take_places(found);
        planes_.resize(std::max(planes_.size(), places_.size()));
        shade_cube(cube_, query, std::span(places_).subspan(found.first),
                   std::span(planes_).subspan(found.first, found.count));
    }
}

/// Writes the found cells in the order of the layer: first counts those of each row.
void CubeSearch::write(bool shaded, CellSet& out) {
    next_.clear();
    for (std::size_t i = 0; i < found_.size(); ++i) {
        if (i == 0 || found_[i].y != found_[i - 1].y)
            next_.emplace_back();
        add_counts(found_[i].rows, next_.back());
    }
    const auto [width, height, depth] = store_.info().grid.cells();
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

void CubeSearch::need(std::uint32_t x, std::uint32_t y, std::uint32_t layer) {
    static const Chunk expected; // stands for a chunk until it has been read
    const std::size_t i = layer + 1 - layer_;
    const std::uint32_t place = chunks_.place(x, y);
    if (there_[i][place])
        return;
    there_[i][place] = &expected;
    missing_[i].push_back(place);
}

/// Reads the chunks that are needed and not there.
void CubeSearch::fetch(const LayerCandidates& candidates, std::uint32_t step,
                       const std::stop_token& stop) {
    for (std::uint32_t i = 0; i < missing_.size(); ++i) {
        std::ranges::sort(missing_[i]);
        std::vector<std::uint32_t> others = missing_[i];
        candidates.keep_unannounced(layer_ + i - 1, others);
        if (!others.empty()) // announces all of them before waiting for any
            store_.expect(step, layer_ + i - 1, others);
    }
    for (std::uint32_t i = 0; i < missing_.size(); ++i) {
        const std::vector<std::uint32_t> places = std::exchange(missing_[i], {});
        if (places.empty())
            continue;
        std::vector<ChunkPtr> chunks = store_.chunks(step, layer_ + i - 1, places, stop);
        for (std::size_t at = 0; at < places.size(); ++at) {
            there_[i][places[at]] = chunks[at].get();
            held_.push_back(std::move(chunks[at]));
        }
    }
}

/// Moves the cube to a chunk, and copies to it what is there of the chunks around.
void CubeSearch::fill_cube(std::uint32_t step, std::uint32_t x, std::uint32_t y,
                           ChunksAround around) {
    cube_.begin(step, {x, y, layer_});
    for_each_around(around | 1u << kOwnChunk, {x, y, layer_}, chunks_,
                    [&](unsigned bit, std::uint32_t cx, std::uint32_t cy, std::uint32_t layer) {
                        cube_.copy(bit, *there_[layer + 1 - layer_][chunks_.place(cx, cy)]);
                    });
}

} // namespace isochron::index
