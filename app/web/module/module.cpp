// What the page computes as WebAssembly: checks and unpacks chunks, finds cells, and makes triangles,
// by the program's own sources.
//
// One array of an index at one level of detail is a Volume. Whoever calls gives and takes places in
// the module's memory, from `take`.
#include "index/extraction/slice_runs.h"
#include "index/file/blended_ranks.h"
#include "index/file/chunks/chunk_codec.h"
#include "index/file/chunks/chunk_grid.h"
#include "index/file/chunks/chunk_table.h"
#include "index/file/sections/file_layout.h"
#include "index/file/sections/step_levels.h"
#include "index/scan/scan.h"
#include "index/search/brick_reach.h"
#include "index/surface/cell_colors.h"
#include "index/surface/mesh_maker.h"
#include "index/volume/level_map.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <vector>

#define EXPORT(name) __attribute__((export_name(name)))

namespace isochron::index {

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

} // namespace isochron::index

/// Nothing of a thread is destroyed: the module has one, which does not end.
extern "C" int __cxa_thread_atexit(void (*)(void*), void*, void*) {
    return 0;
}

namespace isochron::web {

using namespace isochron::index;

/// What the page says of a volume; numbers of the page are doubles.
struct Description {
    double type, slope, intercept;
    std::array<double, 3> vertices, spacing;
    std::array<double, 9> direction; ///< column after column
    double has_bricks, has_since;
};

/// The surface of one chunk.
struct Surface {
    std::vector<CellId> ids; ///< cells of the cube
    MeshPart mesh;
    std::vector<std::uint16_t> cells; ///< x, y, z of each cell in the grid
    std::vector<float> points, normals;
    std::vector<float> values; ///< values of this array at the points of another one's surface
};

/// What a plane cuts.
struct Slice {
    std::optional<SliceRuns> runs;
    SliceValues values;
    std::vector<std::uint32_t> chunks; ///< layer and place of each that it needs
    std::vector<float> outline;        ///< in distances along the axes of the grid
};

struct Volume {
    explicit Volume(const Description& of, const Grid& grid_of)
        : grid(grid_of), type(static_cast<ValueType>(of.type)), scaling{of.slope, of.intercept},
          chunks(grid), has_bricks(of.has_bricks != 0), has_since(of.has_since != 0) {}

    Grid grid;
    ValueType type;
    Scaling scaling;
    ChunkGrid chunks;
    bool has_bricks, has_since;
    std::array<std::optional<LevelMap>, 2> levels; ///< for the step, and for the next one
    double isovalue = 0;
    // Between two steps:
    std::optional<Blend> blend;
    std::optional<BlendedRanks> ranks; ///< none without bricks
    std::optional<LevelMap::Cut> cut;
    MeshMaker maker;
    std::array<std::vector<std::byte>, 2> cubes; ///< the step's, and the next one's
    std::vector<std::byte> blended;
    Surface surface;
    Slice slice;

    std::size_t head_bytes() const {
        return sizeof(RecordChecksum) + (has_bricks ? sizeof(ChunkBricks) : 0);
    }
};

Grid grid_of(const Description& of, const double* positions) {
    Grid grid;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        grid.vertices[k] = static_cast<std::uint32_t>(of.vertices[k]);
        grid.spacing[axis] = of.spacing[k];
        for (int row = 0; row < 3; ++row)
            grid.direction[axis][row] = of.direction[3 * k + static_cast<std::size_t>(row)];
    }
    // The number of distances along each axis, 0 where they are even, then the distances.
    const double* at = positions + 3;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto count = static_cast<std::size_t>(positions[axis]);
        if (count > 0)
            grid.positions[axis] = AxisPositions(std::vector<double>(at, at + count));
        at += count;
    }
    return grid;
}

/// The part of the grid that a chunk's cells and their normals need, along an axis.
struct Reach {
    std::uint32_t first, end;
};
Reach reach_of(const Volume& volume, std::size_t axis, std::uint32_t chunk) {
    const std::uint32_t begin = chunk * kChunkEdge;
    return {begin - (begin > 0 ? 1 : 0),
            std::min(begin + kChunkEdge + 2, volume.grid.vertices[axis])};
}

/// Copies what a neighboring chunk has of a cube.
void copy_to_cube(const Volume& volume, std::vector<std::byte>& cube,
                  const std::array<Reach, 3>& reach, const std::array<std::uint32_t, 3>& chunk,
                  const std::byte* values) {
    const std::size_t word = size_of(volume.type);
    std::array<std::uint32_t, 3> begin, end, size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t first = chunk[axis] * kChunkEdge;
        size[axis] = std::min(kChunkEdge, volume.grid.vertices[axis] - first);
        begin[axis] = std::max(reach[axis].first, first);
        end[axis] = std::min(reach[axis].end, first + size[axis]);
        if (begin[axis] >= end[axis])
            return;
    }
    const std::size_t row = reach[0].end - reach[0].first,
                      plane = row * (reach[1].end - reach[1].first);
    for (std::uint32_t z = begin[2]; z < end[2]; ++z)
        for (std::uint32_t y = begin[1]; y < end[1]; ++y) {
            const std::size_t from =
                (std::size_t{z - chunk[2] * kChunkEdge} * size[1] + y - chunk[1] * kChunkEdge) *
                    size[0] +
                begin[0] - chunk[0] * kChunkEdge;
            const std::size_t to = (z - reach[2].first) * plane + (y - reach[1].first) * row +
                                   begin[0] - reach[0].first;
            std::memcpy(cube.data() + to * word, values + from * word, (end[0] - begin[0]) * word);
        }
}

/// The vertices of a chunk's cells, and those around them that normals need.
struct Cube {
    StepValues values;                  ///< a grid of its own
    std::array<std::uint32_t, 3> first; ///< its first vertex in the grid of the volume
    std::array<std::uint32_t, 3> begin; ///< the chunk's first vertex in the cube
};

/// @param around_next chunks at the next step, between the two; else null
Cube fill_cube(Volume& volume, std::uint32_t layer, std::uint32_t place,
               const std::byte* const* around, const std::byte* const* around_next) {
    const auto [cx, cy] = volume.chunks.at(place);
    const std::array<std::uint32_t, 3> chunk{cx, cy, layer};
    std::array<Reach, 3> reach;
    std::array<std::uint32_t, 3> first, end, begin;
    std::size_t count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        reach[axis] = reach_of(volume, axis, chunk[axis]);
        first[axis] = reach[axis].first;
        end[axis] = reach[axis].end;
        begin[axis] = chunk[axis] * kChunkEdge - first[axis];
        count *= end[axis] - first[axis];
    }
    const auto fill = [&](std::vector<std::byte>& cube, const std::byte* const* chunks_around) {
        cube.assign(count * size_of(volume.type), std::byte{0});
        for (std::uint32_t bit = 0; bit < kChunksAround; ++bit)
            if (chunks_around[bit])
                copy_to_cube(volume, cube, reach,
                             {cx + bit % 3 - 1, cy + bit / 3 % 3 - 1, layer + bit / 9 - 1},
                             chunks_around[bit]);
    };
    fill(volume.cubes[0], around);
    StepValues values{.grid = volume.grid.part(first, end),
                      .type = volume.type,
                      .scaling = volume.scaling,
                      .steps = 1,
                      .first = volume.cubes[0].data()};
    if (around_next && volume.blend) {
        const Blend& blend = *volume.blend;
        fill(volume.cubes[1], around_next);
        volume.blended.resize(count * size_of(blend.type()));
        blend(volume.cubes[0], volume.cubes[1], volume.blended.data());
        values.type = blend.type();
        values.scaling = blend.scaling();
        values.first = volume.blended.data();
    }
    return {std::move(values), first, begin};
}

/// Calls `f(x, y, z)` for the cells of some bricks of a cube's chunk, ascending.
template <class F>
void for_each_cell(const Cube& cube, BricksOfChunk bricks, const F& f) {
    const auto cells = cube.values.grid.cells();
    for (std::uint32_t z = 0; z < kChunkEdge && cube.begin[2] + z < cells[2]; ++z)
        for (std::uint32_t y = 0; y < kChunkEdge && cube.begin[1] + y < cells[1]; ++y)
            for (std::uint32_t x = 0; x < kChunkEdge && cube.begin[0] + x < cells[0]; ++x) {
                const std::uint32_t brick =
                    x / BrickGrid::kCells[0] +
                    kChunkBricks[0] *
                        (y / BrickGrid::kCells[1] + kChunkBricks[1] * (z / BrickGrid::kCells[2]));
                if (bricks >> brick & 1)
                    f(cube.begin[0] + x, cube.begin[1] + y, cube.begin[2] + z);
            }
}

EXPORT("take") void* take(std::size_t bytes) {
    return std::aligned_alloc(64, (bytes + 63) / 64 * 64);
}
EXPORT("give") void give(void* memory) {
    std::free(memory);
}

/// XXH3-64 of bytes, as two numbers of 32 bits.
EXPORT("checksum") void checksum(const std::byte* bytes, std::size_t count, std::uint32_t* out) {
    const std::uint64_t sum = checksum_of({bytes, count});
    out[0] = static_cast<std::uint32_t>(sum);
    out[1] = static_cast<std::uint32_t>(sum >> 32);
}

EXPORT("volume") Volume* volume(const Description* of, const double* positions) {
    return new Volume(*of, grid_of(*of, positions));
}
EXPORT("close") void close(Volume* volume) {
    delete volume;
}

/// The place of a chunk in its layer.
EXPORT("place") std::uint32_t place(const Volume* volume, std::uint32_t x, std::uint32_t y) {
    return volume->chunks.place(x, y);
}
/// Chunk coordinates x + 65536 y of a place.
EXPORT("at") std::uint32_t at(const Volume* volume, std::uint32_t place) {
    const auto [x, y] = volume->chunks.at(place);
    return x | y << 16;
}
/// Bytes of the values of a chunk.
EXPORT("chunk_bytes")
std::uint32_t chunk_bytes(const Volume* volume, std::uint32_t layer, std::uint32_t place) {
    const auto [x, y, z] = volume->chunks.size(layer, place);
    return static_cast<std::uint32_t>(x * y * z * size_of(volume->type));
}
EXPORT("table_bytes") std::uint32_t table_bytes(const Volume* volume) {
    return static_cast<std::uint32_t>(
        layer_table_bytes(volume->chunks.chunks_of_layer(), volume->has_since));
}

/// Sets the levels of a step's bricks. @param which 0: of the step, 1: of the next one
/// @param bytes of the file; none for types of one byte, and without bricks @return 0 if they are damaged
EXPORT("set_levels")
int set_levels(Volume* volume, int which, const std::byte* bytes, std::size_t count) {
    if (!volume->has_bricks)
        return 1;
    auto& levels = volume->levels[static_cast<std::size_t>(which)];
    levels = has_step_levels(volume->type)
                 ? step_levels(volume->type, {bytes, count})
                 : std::optional<LevelMap>(LevelMap::of_type(volume->type));
    return levels ? 1 : 0;
}
/// Sets the moment, after the levels. @param fraction of the way to the next step, see Instant
/// @param isovalues those that will be asked for, one; null: any
void set_moment(Volume& volume, std::uint32_t fraction, std::span<const double> isovalues) {
    volume.blend.reset();
    if (fraction > 0)
        volume.blend.emplace(volume.type, volume.scaling, fraction, isovalues);
}
/// Sets the moment for an array by whose values a surface is colored: no isovalue is asked for.
EXPORT("set_colors") void set_colors(Volume* volume, std::uint32_t fraction) {
    set_moment(*volume, fraction, {});
}
/// Sets moment and isovalue, after the levels. @return 0: no cell is active
EXPORT("set_query") int set_query(Volume* volume, std::uint32_t fraction, double isovalue) {
    set_moment(*volume, fraction, {&isovalue, 1});
    volume->isovalue = isovalue;
    volume->ranks.reset();
    volume->cut.reset();
    if (!volume->has_bricks)
        return 1;
    if (!volume->levels[0] || (volume->blend && !volume->levels[1]))
        return 0;
    const auto& [now, next] = volume->levels;
    if (const auto& blend = volume->blend) {
        volume->ranks.emplace(*now, *next, volume->scaling, *blend, fraction, blend->isovalues());
        volume->cut = volume->ranks->levels()->cut(blend->scaling(), isovalue);
    } else {
        volume->cut = now->cut(volume->scaling, isovalue);
    }
    return volume->cut ? 1 : 0;
}

/// The entries of a layer's table. @return null: the checksum does not match
const std::byte* entries_of(const Volume& volume, const std::byte* table) {
    LayerHead head;
    std::memcpy(&head, table, sizeof head);
    const std::size_t size = table_bytes(&volume) - sizeof head.checksum;
    return checksum_of({table + sizeof head.checksum, size}) == head.checksum ? table + sizeof head
                                                                              : nullptr;
}

/// The chunks of a layer that may hold active cells. @param table of the layer, as in the file
/// @param table_next at the next step, between the two; else null
/// @param out gets their places, ascending @return their number; -1: the checksum does not match
EXPORT("candidates")
int candidates(const Volume* volume, const std::byte* table, const std::byte* table_next,
               std::uint32_t* out) {
    const std::byte* const now = entries_of(*volume, table);
    const std::byte* const next = table_next ? entries_of(*volume, table_next) : nullptr;
    if (!now || (table_next && !next))
        return -1;
    const std::size_t size = volume->has_since ? sizeof(ChunkEntry) : kEntryWithoutSince;
    int count = 0;
    for (std::uint32_t i = 0; i < volume->chunks.chunks_of_layer(); ++i) {
        ChunkEntry entry, later;
        std::memcpy(&entry, now + i * size, size);
        if (volume->ranks && next) {
            std::memcpy(&later, next + i * size, size);
            volume->ranks->blend({&entry.low, 1}, {&entry.high, 1}, {&later.low, 1},
                                 {&later.high, 1});
        }
        if (!volume->has_bricks || (volume->cut && volume->cut->may_hold(entry.low, entry.high)))
            out[count++] = i;
    }
    return count;
}

/// Checks the table of a layer. @return 0: it is damaged
EXPORT("check_table") int check_table(const Volume* volume, const std::byte* table) {
    return entries_of(*volume, table) ? 1 : 0;
}
/// Checks a record. @return 0: it is damaged
EXPORT("check") int check(const Volume* volume, const std::byte* record, std::size_t count) {
    RecordChecksum sum;
    if (count < volume->head_bytes())
        return 0;
    std::memcpy(&sum, record, sizeof sum);
    return static_cast<RecordChecksum>(checksum_of({record + sizeof sum, count - sizeof sum})) ==
           sum;
}
/// Unpacks the values of a record that has been checked. @return 0: it is damaged
EXPORT("unpack")
int unpack(const Volume* volume, std::uint32_t layer, std::uint32_t place, const std::byte* record,
           std::size_t count, std::byte* out) {
    const std::size_t head = volume->head_bytes();
    return unpack_chunk(volume->type, volume->chunks.size(layer, place),
                        {record + head, count - head}, {out, chunk_bytes(volume, layer, place)});
}
/// The bricks of a record that may hold active cells, and in `around` the chunks that they need.
/// @param record_next at the next step, between the two; else null
EXPORT("bricks")
std::uint32_t bricks(const Volume* volume, const std::byte* record, const std::byte* record_next,
                     std::uint32_t* around) {
    ChunkBricks found, next;
    std::memcpy(found.data(), record + sizeof(RecordChecksum), sizeof found);
    if (volume->ranks && record_next) {
        std::memcpy(next.data(), record_next + sizeof(RecordChecksum), sizeof next);
        const auto halves = [](ChunkBricks& of) {
            return std::pair(std::span(of).first(kBricksOfChunk),
                             std::span(of).last(kBricksOfChunk));
        };
        const auto [low, high] = halves(found);
        const auto [low_next, high_next] = halves(next);
        volume->ranks->blend(low, high, low_next, high_next);
    }
    const BricksOfChunk bits = volume->cut ? bricks_of(found, *volume->cut) : 0;
    *around = joined(bits, kChunksOfBrickWithNormals);
    return bits;
}

/// Finds the active cells of a chunk, and makes their triangles.
/// @param of_bricks its bricks that may hold active cells
/// @param around values of the chunks around it by their bit (index/search/chunk_reach.h); null: not needed
/// @param around_next those at the next step, between the two; else null
/// @return number of cells
EXPORT("find")
std::uint32_t find(Volume* volume, std::uint32_t layer, std::uint32_t place,
                   std::uint32_t of_bricks, const std::byte* const* around,
                   const std::byte* const* around_next) {
    const Cube of_chunk = fill_cube(*volume, layer, place, around, around_next);
    const StepValues& cube = of_chunk.values;
    const auto& first = of_chunk.first;
    const Query query{Instant(0), volume->isovalue};
    Surface& made = volume->surface;
    made.ids.clear();
    for_each_cell(of_chunk, of_bricks, [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        made.ids.push_back(static_cast<CellId>(wide_id(cube.grid, x, y, z)));
    });
    keep_active(cube, query, made.ids);
    made.cells.clear();
    for (const CellId id : made.ids) {
        const auto local = cube.grid.cell_of(id);
        for (std::size_t axis = 0; axis < 3; ++axis)
            made.cells.push_back(static_cast<std::uint16_t>(local[axis] + first[axis]));
    }
    volume->maker.make(cube, query, made.ids, made.mesh);
    made.points.clear();
    made.normals.clear();
    for (const MeshVertex& vertex : made.mesh.vertices) {
        const glm::dvec3 local = position_of(vertex);
        const Grid& grid = volume->grid;
        const glm::dvec3 to = grid.direction * glm::dvec3(grid.distance(0, local.x + first[0]),
                                                          grid.distance(1, local.y + first[1]),
                                                          grid.distance(2, local.z + first[2]));
        const glm::dvec3 normal = normal_of(vertex);
        for (int axis = 0; axis < 3; ++axis) {
            made.points.push_back(static_cast<float>(to[axis]));
            made.normals.push_back(static_cast<float>(normal[axis]));
        }
    }
    return static_cast<std::uint32_t>(made.ids.size());
}

/// The values of another array at the points that `find` has made of a chunk, interpolated between the
/// ends of their edges. @param of the volume that was searched @param around, around_next chunks of the other array
/// @return their place in memory, a float for each point
EXPORT("values")
const float* values(Volume* other, const Volume* of, std::uint32_t layer, std::uint32_t place,
                    const std::byte* const* around, const std::byte* const* around_next) {
    const Cube of_chunk = fill_cube(*other, layer, place, around, around_next);
    other->surface.values = values_at(of_chunk.values, Instant(0), of->surface.mesh.vertices, 0);
    return other->surface.values.data();
}

/// Begins a slice, after the moment was set by `set_colors`; all its values are missing.
/// @param plane a point on it, less the grid's origin, its unit normal, and the lowest and highest value of the array
/// @param most values and columns of each that are taken @return number of the chunks that it needs; -1: too large
EXPORT("slice") int slice(Volume* volume, const double* plane, std::size_t most) {
    Slice& made = volume->slice;
    made = {};
    const SliceQuery query{.point = {plane[0], plane[1], plane[2]},
                           .normal = {plane[3], plane[4], plane[5]}};
    made.runs.emplace(volume->grid, query);
    if (made.runs->empty())
        return 0;
    if (std::max(made.runs->values(), made.runs->columns()) > most)
        return -1;
    const auto& blend = volume->blend;
    made.values = made.runs->empty_slice({plane[6], plane[7]}, blend ? blend->type() : volume->type,
                                         blend ? blend->scaling() : volume->scaling);
    for (const glm::dvec3& corner : made.values.outline)
        for (int axis = 0; axis < 3; ++axis)
            made.outline.push_back(static_cast<float>(corner[axis] * volume->grid.spacing[axis]));
    const auto places = made.runs->chunks(volume->chunks);
    for (std::uint32_t layer = 0; layer < places.size(); ++layer)
        for (const std::uint32_t place : places[layer])
            made.chunks.insert(made.chunks.end(), {layer, place});
    return static_cast<int>(made.chunks.size() / 2);
}
/// Copies what a chunk has of the slice. @param values of the chunk, unpacked
/// @param values_next those at the next step, between the two; else null
EXPORT("slice_chunk")
void slice_chunk(Volume* volume, std::uint32_t layer, std::uint32_t place, const std::byte* values,
                 const std::byte* values_next) {
    const auto size = volume->chunks.size(layer, place);
    const std::size_t bytes = chunk_bytes(volume, layer, place);
    std::span<const std::byte> filled(values, bytes);
    if (values_next && volume->blend) {
        const Blend& blend = *volume->blend;
        volume->blended.resize(bytes / size_of(volume->type) * size_of(blend.type()));
        blend(filled, {values_next, bytes}, volume->blended.data());
        filled = volume->blended;
    }
    const auto [x, y] = volume->chunks.at(place);
    volume->slice.runs->copy(filled, {x * kChunkEdge, y * kChunkEdge, layer * kChunkEdge}, size,
                             volume->slice.values);
}

std::uint32_t place_of(const void* memory) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(memory));
}
/// What a slice has: chunks, columns, shares, outline as places in memory, then how many columns,
/// shares and numbers of the outline, and the axis of the columns.
EXPORT("sliced") void sliced(const Volume* volume, std::uint32_t* out) {
    const Slice& made = volume->slice;
    const auto count_of = [](const auto& of) { return static_cast<std::uint32_t>(of.size()); };
    out[0] = place_of(made.chunks.data());
    out[1] = place_of(made.values.columns.data());
    out[2] = place_of(made.values.shares.data());
    out[3] = place_of(made.outline.data());
    out[4] = count_of(made.values.columns);
    out[5] = count_of(made.values.shares);
    out[6] = count_of(made.outline);
    out[7] = static_cast<std::uint32_t>(made.values.axis);
}

/// What `find` has found: cells, points, normals, triangles as places in memory, then how many points
/// and how many triangles.
EXPORT("found") void found(const Volume* volume, std::uint32_t* out) {
    const Surface& made = volume->surface;
    out[0] = place_of(made.cells.data());
    out[1] = place_of(made.points.data());
    out[2] = place_of(made.normals.data());
    out[3] = place_of(made.mesh.triangles.data());
    out[4] = static_cast<std::uint32_t>(made.points.size() / 3);
    out[5] = static_cast<std::uint32_t>(made.mesh.triangles.size() / 3);
}

} // namespace isochron::web
