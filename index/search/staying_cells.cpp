// Finds the cells around chunks that have changed.
#include "index/search/staying_cells.h"

#include <algorithm>

namespace isochron::index {

/// By chunk around (a bit of ChunksAround): the regions whose cells reach it.
constexpr std::array<std::uint32_t, kChunksAround> StayingCells::kRegionsNeeding = [] {
    std::array<std::uint32_t, kChunksAround> needing{};
    for (unsigned bit = 0; bit < kChunksAround; ++bit)
        for (unsigned region = 0; region < kRegions * kRegions * kRegions; ++region) {
            bool reached = true;
            for (unsigned d = bit, r = region, axis = 0; axis < 3; ++axis, d /= 3, r /= kRegions)
                reached = reached && (d % 3 == 1 || d % 3 == r % kRegions);
            needing[bit] |= std::uint32_t{reached} << region;
        }
    return needing;
}();

StayingCells::StayingCells(const StepView& step, Instant at, bool normals)
    : chunks_(&step.chunk_grid()), changed_(chunks_->count()), others_(chunks_->count()),
      around_(chunks_->count()) {
    const std::uint32_t earlier = std::min(step.at().step, at.step),
                        later = std::max(step.at().step, at.step);
    if (earlier == later)
        return;
    const SidesNeeding& needing = normals ? kSidesNeedingWithNormals : kSidesNeeding;
    const std::uint32_t places = chunks_->chunks_of_layer();
    for (std::uint32_t layer = 0; layer < chunks_->layers(); ++layer) {
        const ChunkLayerPtr table = step.store().layer(later, layer);
        for (std::uint32_t place = 0; place < places; ++place) {
            if (table->since[place] <= earlier)
                continue;
            changed_[std::size_t{layer} * places + place] = 1;
            const auto [x, y] = chunks_->at(place);
            // A chunk is seen from each of its neighbors in the opposite direction.
            for_each_around(
                (1u << kChunksAround) - 1, {x, y, layer}, *chunks_,
                [&](unsigned bit, std::uint32_t cx, std::uint32_t cy, std::uint32_t cz) {
                    others_[number(cx, cy, cz)] |= needing[kChunksAround - 1 - bit];
                    around_[number(cx, cy, cz)] |= kRegionsNeeding[kChunksAround - 1 - bit];
                });
        }
    }
}

double staying_share(const StepView& step, Instant at, std::span<const double> isovalues) {
    const std::uint32_t earlier = std::min(step.at().step, at.step);
    const ChunkStore& store = step.store();
    std::size_t all = 0, stay = 0;
    for (const double isovalue : isovalues) {
        const auto cut = step.cut(isovalue);
        for (std::uint32_t layer = 0; cut && layer < store.grid().layers(); ++layer) {
            const ChunkLayerPtr table = store.layer(step.at().step, layer);
            const ChunkLayerPtr later = at > step.at() ? store.layer(at.step, layer) : table;
            for (std::uint32_t place = 0; place < table->low.size(); ++place)
                if (cut->may_hold(table->low[place], table->high[place])) {
                    ++all;
                    stay += later->since[place] <= earlier ? 1 : 0;
                }
        }
    }
    return all == 0 ? 1.0 : static_cast<double>(stay) / static_cast<double>(all);
}

} // namespace isochron::index
