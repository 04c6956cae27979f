// The values at places in an open index.
#include "index/extraction/value_in_index.h"

#include "index/file/step_view.h"
#include "index/volume/sample.h"

#include <array>
#include <limits>
#include <map>
#include <utility>

namespace isochron::index {
namespace {

/// Scaled values of vertices, whose chunks are read once.
class ChunkVertices {
  public:
    explicit ChunkVertices(const StepView& view) : view_(view) {}

    double operator()(const std::array<std::uint32_t, 3>& vertex) {
        const std::uint32_t layer = vertex[2] / kChunkEdge;
        const std::uint32_t place =
            view_.chunk_grid().place(vertex[0] / kChunkEdge, vertex[1] / kChunkEdge);
        ChunkPtr& chunk = chunks_[{layer, place}];
        if (!chunk)
            chunk = view_.chunks(layer, std::span(&place, 1), {}).front();
        const std::size_t in_chunk =
            (std::size_t{vertex[2] % kChunkEdge} * chunk->size[1] + vertex[1] % kChunkEdge) *
                chunk->size[0] +
            vertex[0] % kChunkEdge;
        return visit_value_type(view_.type(), [&]<class T>(std::type_identity<T>) {
            const auto* values = reinterpret_cast<const T*>(chunk->values.data());
            return view_.scaling()(static_cast<double>(values[in_chunk]));
        });
    }

  private:
    const StepView& view_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, ChunkPtr> chunks_; ///< by layer and place
};

} // namespace

std::vector<double> values_in(const IndexFile& file, Instant instant,
                              std::span<const glm::dvec3> places, const std::stop_token& stop) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const StepView view = step_of(file, instant);
    ChunkVertices vertices(view);
    const ScaledVertex vertex = [&](const auto& at) { return vertices(at); };
    std::vector<double> values;
    for (const glm::dvec3& at : places) {
        if (stop.stop_requested())
            throw Stopped();
        values.push_back((view.by_chunks() ? value_at(view.grid(), at, vertex)
                                           : value_at(view.whole(stop).values, instant.step, at))
                             .value_or(kNone));
    }
    return values;
}

std::optional<double> value_in(const IndexFile& file, Instant instant, const glm::dvec3& at) {
    const double value = values_in(file, instant, std::span(&at, 1)).front();
    return value == value ? std::optional(value) : std::nullopt;
}

} // namespace isochron::index
