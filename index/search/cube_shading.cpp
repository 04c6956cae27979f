// Makes planes of a chunk's cells, whose values are all in the nearest cache.
#include "index/search/cube_shading.h"
#include "index/volume/cell_difference.h"

#include <cassert>
#include <cstddef>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/search/cube_shading.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include "index/surface/cell_planes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

template <class T>
void shade_places(const ChunkCube& cube, const Query& query, std::span<const PlaceInChunk> cells,
                  std::span<std::uint32_t> planes) {
    const StepValues& values = cube.values();
    Shaders<T> shaders(values, query.isovalue);
    const auto first = cube.first();
    const auto& n = values.grid.vertices;
    const std::size_t row = n[0], slice = row * n[1];
    const T* const volume = values.step<T>(query.instant.step).data();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::uint32_t x = first[0] + cells[i] % kChunkEdge,
                            y = first[1] + cells[i] / kChunkEdge % kChunkEdge,
                            z = first[2] + cells[i] / kChunkEdge / kChunkEdge;
        if constexpr (Shaders<T>::kFast) {
            // Numbers are unsigned: at 0 this is false, too.
            const bool inner = x - 1 < n[0] - 3 && y - 1 < n[1] - 3 && z - 1 < n[2] - 3;
            if (inner && shaders.float_is_enough && n[0] > 3 && n[1] > 3 && n[2] > 3) {
                shaders.fast.add(planes[i], volume + z * slice + y * row + x);
                continue;
            }
        }
        shaders.add_exact(planes[i], CellDifferences<T>(values, query.instant.step, y, z),
                          values.grid, {x, y, z});
    }
    shaders.finish();
}

void shade_places_of(const ChunkCube& cube, const Query& query, std::span<const PlaceInChunk> cells,
                     std::span<std::uint32_t> planes) {
    visit_value_type(cube.values().type, [&]<class T>(std::type_identity<T>) {
        shade_places<T>(cube, query, cells, planes);
    });
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(shade_places_of);

void shade_cube(const ChunkCube& cube, const Query& query, std::span<const PlaceInChunk> cells,
                std::span<std::uint32_t> planes) {
    assert(cells.size() == planes.size());
    HWY_DYNAMIC_DISPATCH(shade_places_of)(cube, query, cells, planes);
}

} // namespace isochron::index
#endif
