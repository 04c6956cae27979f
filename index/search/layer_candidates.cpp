// Reads the candidates of a layer, and finds what lies around their bricks.
#include "index/search/layer_candidates.h"

#include <algorithm>

namespace isochron::index {
namespace {

/// By brick of a chunk: where in the chunk its cells lie.
constexpr std::array<SidesOfCells, kBricksOfChunk> kSidesOfBrick = [] {
    std::array<SidesOfCells, kBricksOfChunk> sides{};
    for (std::uint32_t z = 0; z < kChunkEdge; ++z)
        for (std::uint32_t y = 0; y < kChunkEdge; ++y)
            for (std::uint32_t x = 0; x < kChunkEdge; ++x) {
                const std::size_t brick =
                    x / BrickGrid::kCells[0] +
                    kChunkBricks[0] * (y / BrickGrid::kCells[1] +
                                       std::size_t{kChunkBricks[1]} * (z / BrickGrid::kCells[2]));
                sides[brick] |= SidesOfCells{1}
                                << (kSide[x] + kSides * (kSide[y] + kSides * unsigned{kSide[z]}));
            }
    return sides;
}();

} // namespace

BricksOfChunk LayerCandidates::bricks_at(SidesOfCells sides) {
    BricksOfChunk bits = 0;
    for (std::uint32_t i = 0; i < kBricksOfChunk; ++i)
        bits |= ((kSidesOfBrick[i] & sides) != 0 ? 1u : 0u) << i;
    return bits;
}

LayerCandidates::LayerCandidates(const StepView& step, std::uint32_t layer,
                                 const LevelMap::Cut& cut, bool normals,
                                 const std::stop_token& stop, const ChunkFilter& only,
                                 const StayingCells* staying)
    : layer_(layer), places_(places_of(*step.layer(layer), cut, layer, only)), cut_(cut) {
    if (places_.empty())
        return;
    const auto started = std::chrono::steady_clock::now();
    const ChunkGrid& grid = step.chunk_grid();
    for (std::uint32_t i = 0; i < tables_.size(); ++i)
        if (layer + i > 0 && layer + i - 1 < grid.layers())
            tables_[i] = step.layer(layer + i - 1);
    chunks_ = step.cube_chunks(layer, places_, stop);
    for (std::size_t i = 0; i < places_.size(); ++i) {
        bricks_.push_back(index::bricks_of(chunks_[i]->bricks, cut));
        if (staying)
            bricks_.back() &= bricks_at(staying->others(layer, places_[i]));
        const auto [x, y] = grid.at(places_[i]);
        const ChunksAround around =
            joined(bricks_[i], normals ? kChunksOfBrickWithNormals : kChunksOfBrick);
        for_each_around(around & ~(1u << kOwnChunk), {x, y, layer}, grid,
                        [&](unsigned bit, std::uint32_t cx, std::uint32_t cy, std::uint32_t) {
                            around_[bit / 9].push_back(grid.place(cx, cy));
                        });
    }
    std::array<std::vector<std::uint32_t>, 3> announced;
    for (std::uint32_t i = 0; i < around_.size(); ++i) {
        std::vector<std::uint32_t>& places = around_[i];
        std::ranges::sort(places);
        const auto repeated = std::ranges::unique(places);
        places.erase(repeated.begin(), repeated.end());
        std::erase_if(places, [&](std::uint32_t place) { // candidates have been announced
            return may_hold(tables_[i]->low[place], tables_[i]->high[place], cut);
        });
        if (tables_[i] &&
            !step.store().fetches_all(count_of(*tables_[i], cut, layer + i - 1, only)))
            announced[i] = places;
    }
    step.expect(layer - 1, announced);
    time_ = std::chrono::steady_clock::now() - started;
}

std::vector<std::uint32_t> LayerCandidates::places_of(const ChunkLayer& table,
                                                      const LevelMap::Cut& cut, std::uint32_t layer,
                                                      const ChunkFilter& only) {
    std::vector<std::uint32_t> places;
    for (std::uint32_t place = 0; place < table.low.size(); ++place)
        if (may_hold(table.low[place], table.high[place], cut) && (!only || only(layer, place)))
            places.push_back(place);
    return places;
}

std::size_t LayerCandidates::count_of(const ChunkLayer& table, const LevelMap::Cut& cut,
                                      std::uint32_t layer, const ChunkFilter& only) {
    if (only)
        return places_of(table, cut, layer, only).size();
    std::size_t count = 0; // counted by a plain loop, which the compiler makes one of vectors
    for (std::size_t place = 0; place < table.low.size(); ++place)
        count += may_hold(table.low[place], table.high[place], cut) ? 1 : 0;
    return count;
}

ChunksAround LayerCandidates::reach(std::size_t i) const {
    return joined(bricks_[i], kChunksOfBrick);
}

void LayerCandidates::keep_unannounced(std::uint32_t layer,
                                       std::vector<std::uint32_t>& places) const {
    const std::size_t i = layer + 1 - layer_;
    if (!tables_[i])
        return;
    std::erase_if(places, [&](std::uint32_t place) {
        return may_hold(tables_[i]->low[place], tables_[i]->high[place], cut_) ||
               std::ranges::binary_search(around_[i], place);
    });
}

void PreparedCandidates::prepare(std::uint32_t layer) {
    Layer& it = of_[layer];
    const std::scoped_lock lock(it.mutex);
    if (it.there)
        return;
    it.candidates = read_(layer);
    it.there = true;
}

LayerCandidates PreparedCandidates::take(std::uint32_t layer) {
    prepare(layer);
    return std::exchange(of_[layer].candidates, {});
}

} // namespace isochron::index
