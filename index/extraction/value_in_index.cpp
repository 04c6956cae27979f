// The value at a place in an open index.
#include "index/extraction/value_in_index.h"

#include "index/volume/sample.h"

#include <array>
#include <span>

namespace isochron::index {

std::optional<double> value_in(const IndexFile& file, std::uint32_t step, const glm::dvec3& at) {
    if (file.better_whole(step))
        return value_at(file.load(step).values, step, at);
    const ChunkStore& store = file.chunks();
    const SeriesInfo& info = store.info();
    return value_at(info.grid, at, [&](const std::array<std::uint32_t, 3>& vertex) {
        const std::uint32_t place =
            store.grid().place(vertex[0] / kChunkEdge, vertex[1] / kChunkEdge);
        const ChunkPtr chunk =
            store.chunks(step, vertex[2] / kChunkEdge, std::span(&place, 1)).front();
        const std::size_t in_chunk =
            (std::size_t{vertex[2] % kChunkEdge} * chunk->size[1] + vertex[1] % kChunkEdge) *
                chunk->size[0] +
            vertex[0] % kChunkEdge;
        return visit_value_type(info.type, [&]<class T>(std::type_identity<T>) {
            const auto* values = reinterpret_cast<const T*>(chunk->values.data());
            return info.scaling(static_cast<double>(values[in_chunk]));
        });
    });
}

} // namespace isochron::index
