// Copies parts of chunks to their places in a cube.
#include "index/search/chunk_cube.h"

#include <algorithm>
#include <cstring>

namespace isochron::index {
namespace {

constexpr std::uint32_t kBelow = 1, kAbove = 2;
constexpr std::size_t kMostVertices = kBelow + kChunkEdge + kAbove;
/// Bytes behind the cube, so that its last rows can be read as whole vectors.
constexpr std::size_t kPadding = 512;

struct Rows {
    const std::byte* from;
    std::byte* to;
    std::size_t from_row, from_plane, to_row, to_plane; ///< [bytes]
    std::uint32_t rows, planes;
};

template <class Width>
void copy_rows_with(const Rows& rows, Width width) {
    const std::byte* from = rows.from;
    std::byte* to = rows.to;
    for (std::uint32_t z = 0; z < rows.planes; ++z, from += rows.from_plane, to += rows.to_plane)
        for (std::uint32_t y = 0; y < rows.rows; ++y)
            std::memcpy(to + y * rows.to_row, from + y * rows.from_row, width);
}

/// Copies rows of so many bytes; the usual widths are compile-time constants.
void copy_rows_of_width(const Rows& rows, std::size_t width) {
    const auto with =
        [&]<std::size_t kWidth>(std::integral_constant<std::size_t, kWidth> constant) {
            copy_rows_with(rows, constant);
        };
    switch (width) {
    case 1: return with(std::integral_constant<std::size_t, 1>());
    case 2: return with(std::integral_constant<std::size_t, 2>());
    case 4: return with(std::integral_constant<std::size_t, 4>());
    case 8: return with(std::integral_constant<std::size_t, 8>());
    case 16: return with(std::integral_constant<std::size_t, 16>());
    case 32: return with(std::integral_constant<std::size_t, 32>());
    case 64: return with(std::integral_constant<std::size_t, 64>());
    case 128: return with(std::integral_constant<std::size_t, 128>());
    default: return copy_rows_with(rows, width);
    }
}

/// The part of a chunk, as rows side by side.
struct Part {
    std::size_t first;             ///< bytes before it
    std::size_t row, plane, width; ///< bytes
    std::uint32_t rows, planes;

    std::size_t bytes() const { return width * rows * planes; }
    bool is_dense() const { return width == row && width * rows == plane; }
};
/// @param room for the part, where its rows are apart @return its values side by side
std::span<const std::byte> dense(const Part& part, std::span<const std::byte> values,
                                 std::byte* room) {
    if (part.is_dense())
        return values.subspan(part.first, part.bytes());
    copy_rows_of_width({.from = values.data() + part.first,
                        .to = room,
                        .from_row = part.row,
                        .from_plane = part.plane,
                        .to_row = part.width,
                        .to_plane = part.width * part.rows,
                        .rows = part.rows,
                        .planes = part.planes},
                       part.width);
    return {room, part.bytes()};
}

} // namespace

void ChunkCube::begin(const StepView& step, const std::array<std::uint32_t, 3>& at) {
    const Grid& grid = step.grid();
    const std::size_t bytes =
        kMostVertices * kMostVertices * kMostVertices * size_of(step.type()) + kPadding;
    memory_.resize(std::max(memory_.size(), bytes / sizeof(std::uint64_t)));
    values_.type = step.type();
    values_.scaling = step.scaling();
    values_.steps = step.steps();
    values_.first = reinterpret_cast<const std::byte*>(memory_.data());
    values_.stride = memory_.size() * sizeof(std::uint64_t);
    values_.first_step = step.at().step;
    blend_ = step.cube_blend();
    stored_ = size_of(step.store().info().type);
    std::array<std::uint32_t, 3> begin{}, end{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t first = at[axis] * kChunkEdge, all = grid.vertices[axis];
        first_[axis] = first > 0 ? kBelow : 0;
        begin[axis] = first - first_[axis];
        end[axis] = std::min(first + kChunkEdge + kAbove, all);
        cells_[axis] = std::min(kChunkEdge, all - 1 - first);
        values_.grid.vertices[axis] = end[axis] - begin[axis];
    }
    if (grid.rectilinear()) {
        values_.grid = grid.part(begin, end);
        return;
    }
    // Else nothing but the numbers of vertices differs from the whole grid.
    values_.grid.origin = grid.origin;
    values_.grid.spacing = grid.spacing;
    values_.grid.direction = grid.direction;
}

void ChunkCube::copy(unsigned bit, const Chunk& chunk) {
    const std::array<unsigned, 3> offset{bit % 3, bit / 3 % 3, bit / 9}; // plus 1
    std::array<std::uint32_t, 3> from{}, to{}, size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t own = first_[axis], all = values_.grid.vertices[axis];
        switch (offset[axis]) {
        case 0:
            from[axis] = kChunkEdge - own;
            size[axis] = own;
            break;
        case 1:
            to[axis] = own;
            size[axis] = std::min(kChunkEdge, all - own);
            break;
        default:
            to[axis] = std::min(own + kChunkEdge, all);
            size[axis] = all - to[axis];
            break;
        }
    }
    const std::size_t word = size_of(values_.type), stored = blend_ ? stored_ : word;
    Part part{0, chunk.size[0] * stored, 0, size[0] * stored, size[1], size[2]};
    part.plane = chunk.size[1] * part.row;
    part.first = from[2] * part.plane + from[1] * part.row + from[0] * stored;
    const std::byte* first = chunk.values.data() + part.first;
    if (blend_) {
        constexpr std::size_t kMost =
            std::size_t{kChunkEdge} * kChunkEdge * kChunkEdge; // values of 8 bytes
        part_.resize(3 * kMost);
        const auto& pair = static_cast<const ChunkPair&>(chunk);
        auto* const blended = reinterpret_cast<std::byte*>(part_.data());
        auto* const a = reinterpret_cast<std::byte*>(part_.data() + kMost);
        auto* const b = reinterpret_cast<std::byte*>(part_.data() + 2 * kMost);
        (*blend_)(dense(part, pair.now->values, a), dense(part, pair.next->values, b), blended);
        first = blended;
        part.row = size[0] * word;
        part.plane = size[1] * part.row;
    }
    const std::size_t to_row = values_.grid.vertices[0] * word;
    const std::size_t to_plane = values_.grid.vertices[1] * to_row;
    auto* const out = reinterpret_cast<std::byte*>(memory_.data());
    copy_rows_of_width({.from = first,
                        .to = out + to[2] * to_plane + to[1] * to_row + to[0] * word,
                        .from_row = part.row,
                        .from_plane = part.plane,
                        .to_row = to_row,
                        .to_plane = to_plane,
                        .rows = size[1],
                        .planes = size[2]},
                       size[0] * word);
}

} // namespace isochron::index
