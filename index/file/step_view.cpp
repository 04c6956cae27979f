// Decides whether a step is worked on as a whole.
#include "index/file/step_view.h"

#include "index/volume/stored_cut.h"

#include <cstring>

namespace isochron::index {

StepView::StepView(const ChunkStore& store, Instant at, std::size_t level,
                   std::span<const double> isovalues)
    : kind_{&store.info().grid, store.info().type, store.info().scaling, store.info().steps()},
      store_(&store), at_(at.within(kind_.steps)), level_(level) {
    set_between(isovalues);
}

StepView::StepView(const Kind& kind, const ChunkStore* store, Instant at, Load load,
                   std::span<const double> isovalues)
    : kind_(kind), store_(store), at_(at.within(kind_.steps)), load_(std::move(load)) {
    set_between(isovalues);
}

void StepView::set_between(std::span<const double> isovalues) {
    if (!between())
        return;
    blend_.emplace(kind_.type, kind_.scaling, at_.fraction, isovalues);
    kind_.type = blend_->type();
    kind_.scaling = blend_->scaling();
    if (store_)
        between_ = std::make_shared<const BetweenSteps>(*store_, at_, *blend_);
}

std::optional<std::uint64_t> StepView::stored_cut(double isovalue) const {
    return index::stored_cut(type(), scaling(), isovalue);
}

const LoadedStep& StepView::whole(const std::stop_token& stop) const {
    if (whole_)
        return *whole_;
    if (!between()) {
        whole_ = load_(at_.step, stop);
    } else {
        const LoadedStep now = load_(at_.step, stop);
        stop_if_asked(stop);
        whole_ = BetweenSteps::whole(now, load_(at_.step + 1, stop), at_, store_, *blend_);
    }
    return *whole_;
}

LevelMapPtr StepView::levels() const {
    if (between_)
        return between_->levels();
    if (!by_chunks() && store_->is_small() && store_->carries_values())
        whole({});
    return store_->levels(at_.step);
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
        const std::byte* const first = all.values.step_bytes(at_.step).data() +
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

StepView as_a_whole(const IndexFile& file, Instant at, std::span<const double> isovalues = {}) {
    const SeriesInfo& info = file.info();
    return {
        {&info.grid, info.type, info.scaling, info.steps()},
        &file.chunks(),
        at,
        [&file](std::uint32_t step, const std::stop_token& stop) { return file.load(step, stop); },
        isovalues};
}

} // namespace

StepView step_of(const IndexFile& file, Instant at, std::span<const double> isovalues) {
    // Between two steps only what is needed is blended.
    if (at.within(file.info().steps()).between() && !file.referral())
        return step_in_chunks(file, at, 0, isovalues);
    return file.better_whole(at.step) ? as_a_whole(file, at, isovalues)
                                      : step_in_chunks(file, at, 0, isovalues);
}

StepView part_of_step(const IndexFile& file, Instant at) {
    if (at.within(file.info().steps()).between())
        return step_of(file, at);
    const ChunkStore& store = file.chunks();
    const bool there = file.referral() || store.holds_whole(at.step);
    return there || (store.is_small() && file.better_whole(at.step)) ? as_a_whole(file, at)
                                                                     : step_in_chunks(file, at);
}

StepView step_in_chunks(const IndexFile& file, Instant at, std::size_t level,
                        std::span<const double> isovalues) {
    return {file.chunks(level), at, level, isovalues};
}

} // namespace isochron::index
