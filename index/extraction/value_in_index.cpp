// The value at a place in an open index.
#include "index/extraction/value_in_index.h"

#include "index/file/step_view.h"
#include "index/volume/sample.h"

#include <array>
#include <span>

namespace isochron::index {

std::optional<double> value_in(const IndexFile& file, Instant instant, const glm::dvec3& at) {
    const StepView view = step_of(file, instant);
    if (!view.by_chunks())
        return value_at(view.whole({}).values, instant.step, at);
    return value_at(view.grid(), at, [&](const std::array<std::uint32_t, 3>& vertex) {
        const std::uint32_t place =
            view.chunk_grid().place(vertex[0] / kChunkEdge, vertex[1] / kChunkEdge);
        const ChunkPtr chunk =
            view.chunks(vertex[2] / kChunkEdge, std::span(&place, 1), {}).front();
        const std::size_t in_chunk =
            (std::size_t{vertex[2] % kChunkEdge} * chunk->size[1] + vertex[1] % kChunkEdge) *
                chunk->size[0] +
            vertex[0] % kChunkEdge;
        return visit_value_type(view.type(), [&]<class T>(std::type_identity<T>) {
            const auto* values = reinterpret_cast<const T*>(chunk->values.data());
            return view.scaling()(static_cast<double>(values[in_chunk]));
        });
    });
}

} // namespace isochron::index
