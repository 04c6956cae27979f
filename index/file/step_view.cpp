// Decides whether a step is worked on as a whole.
#include "index/file/step_view.h"

#include "index/volume/stored_cut.h"

#include <cstring>
#include <memory>

namespace isochron::index {

std::optional<std::uint64_t> StepView::stored_cut(double isovalue) const {
    return index::stored_cut(type(), scaling(), isovalue);
}

const LoadedStep& StepView::whole(const std::stop_token& stop) const {
    if (!whole_)
        whole_ = load_(at_, stop);
    return *whole_;
}

std::vector<ChunkPtr> StepView::cut_out(std::uint32_t layer, std::span<const std::uint32_t> places,
                                        const std::stop_token& stop) const {
    const LoadedStep& all = whole(stop);
    const ChunkGrid& chunks = chunk_grid();
    const BrickGrid bricks(grid());
    const std::size_t size = size_of(type());
    const std::size_t row = grid().vertices[0] * size, plane = grid().vertices[1] * row;
    struct Cut : Chunk {
        std::vector<std::uint64_t> memory;
    };
    std::vector<ChunkPtr> cut;
    for (const std::uint32_t place : places) {
        const auto chunk = std::make_shared<Cut>();
        const auto [x, y] = chunks.at(place);
        chunk->size = chunks.size(layer, place);
        const auto [nx, ny, nz] = chunk->size;
        const std::size_t width = nx * size;
        chunk->memory.resize((width * ny * nz + 7) / 8);
        const auto values = std::as_writable_bytes(std::span(chunk->memory));
        const std::byte* const first = all.values.step_bytes(at_).data() +
                                       layer * kChunkEdge * plane + y * kChunkEdge * row +
                                       x * kChunkEdge * size;
        for (std::size_t z = 0, to = 0; z < nz; ++z)
            for (std::size_t i = 0; i < ny; ++i, to += width)
                std::memcpy(values.data() + to, first + z * plane + i * row, width);
        chunk->values = values.first(width * ny * nz);
        for (std::uint32_t i = 0; !all.bricks.empty() && i < kBricksOfChunk; ++i) {
            const auto brick = brick_of_chunk(bricks, {x, y, layer}, i);
            chunk->bricks[i] = brick ? all.bricks[*brick] : std::uint8_t{255};
            chunk->bricks[kBricksOfChunk + i] =
                brick ? all.bricks[bricks.count() + *brick] : std::uint8_t{0};
        }
        cut.push_back(chunk);
    }
    return cut;
}

namespace {

StepView as_a_whole(const IndexFile& file, Instant at) {
    const SeriesInfo& info = file.info();
    return {
        {&info.grid, info.type, info.scaling, info.steps()},
        &file.chunks(),
        at,
        [&file](std::uint32_t step, const std::stop_token& stop) { return file.load(step, stop); }};
}

} // namespace

StepView step_of(const IndexFile& file, Instant at) {
    return file.better_whole(at) ? as_a_whole(file, at) : step_in_chunks(file, at);
}

StepView part_of_step(const IndexFile& file, Instant at) {
    const bool there = file.referral() || file.chunks().missing_bytes(at) == 0;
    return there ? as_a_whole(file, at) : step_in_chunks(file, at);
}

StepView step_in_chunks(const IndexFile& file, Instant at, std::size_t level) {
    return {file.chunks(level), at, level};
}

} // namespace isochron::index
