// Programs, uniforms and dispatches of the compute passes.
#include "render/cells/cell_compute.h"

#include "render/gl/limits.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <string>

namespace isochron::render {
namespace {

constexpr std::size_t kMostBytes = 64; ///< largest data of a cell in a buffer range: its gradients

/// The uniform block of volume_blocks.glsl, in std140 layout.
struct VolumeBlock {
    std::array<glm::vec4, 3> from_difference;
    glm::ivec3 vertices;
    float factor;
    glm::ivec3 tiles;
    float gradient_scale;
    std::array<float, index::kMostSurfaces> levels;
};
static_assert(sizeof(VolumeBlock) == 3 * 16 + 2 * 16 + 2 * 16);

std::string_view sampler_of(index::ValueType held) {
    switch (held) {
    case index::ValueType::i8:
    case index::ValueType::i16: return "#define BLOCKS isamplerBuffer\n";
    case index::ValueType::u8:
    case index::ValueType::u16: return "#define BLOCKS usamplerBuffer\n";
    default: return "#define BLOCKS samplerBuffer\n";
    }
}

std::string prelude_of(const index::Grid& grid, index::ValueType held) {
    return prelude_for(grid) + std::string(sampler_of(held));
}

/// Rows of the matrix from differences of values along the axes to gradients (covectors) in
/// physical space, towards lower values. Scaled so that the largest entry is 1.
std::array<glm::vec4, 3> from_difference(const index::Grid& grid) {
    const glm::dmat3 matrix = glm::inverse(glm::dmat3(grid.physical_from_index())); // its transpose
    double largest = 0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            largest = std::max(largest, std::abs(matrix[column][row]));
    std::array<glm::vec4, 3> rows{};
    for (int row = 0; row < 3; ++row)
        rows[static_cast<std::size_t>(row)] = glm::vec4(-matrix[row] / largest, 0.0);
    return rows;
}

/// Scales the steepest possible difference of the data set to half of a half's range; then halves
/// resolve differences down to about 1e-9 of it.
float gradient_scale(float range) {
    constexpr float kHalfRange =
        32768.0f / 1.7320508f; // sqrt(3): of three differences at right angles
    return kHalfRange / range;
}

} // namespace

CellCompute::CellCompute(const Gl& gl, const index::Grid& grid, const AxisTable& axes,
                         index::ValueType held)
    : gl_(&gl), grid_(grid), axes_(&axes), at_once_(work_at_once(Limits(gl), kMostBytes)),
      pages_(gl, {shader_file("block_pages.comp")}),
      places_(gl, {shader_file("cell_places.comp")}),
      styles_(gl, {shader_file("cell_styles.comp")}),
      planes_(gl, {shader_file("cell_planes.comp")}, prelude_of(grid, held)),
      corners_(gl, {shader_file("cell_corners.comp")}, prelude_of(grid, held)),
      volume_(gl), work_(gl) {}

void CellCompute::use_volume(const index::Extraction& set, const BlockPool& blocks) const {
    // Mesa 25.0's zink looks for the textures of a program where it put those of what was drawn last,
    // unless a program without textures ran in between or they have changed.
    run(places_, 0, {}, [](std::size_t, std::size_t) {});
    const auto& n = grid_.vertices;
    const auto tiles = index::BlockTiling(grid_).blocks;
    VolumeBlock block{.from_difference = from_difference(grid_),
                      .vertices = {n[0], n[1], n[2]},
                      .factor = set.blocks.factor,
                      .tiles = {tiles[0], tiles[1], tiles[2]},
                      .gradient_scale = gradient_scale(set.blocks.range) * axes_->smallest(),
                      .levels = {}};
    std::ranges::copy(set.levels, block.levels.begin());
    gl_->NamedBufferData(volume_.name(), sizeof(block), &block, GL_STREAM_DRAW);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, volume_.name());
    gl_->BindTextureUnit(0, blocks.pages().texture());
    gl_->BindTextureUnit(1, blocks.values().texture());
    axes_->bind();
}

void CellCompute::bind(GLuint binding, const DeviceArray& array) const {
    gl_->BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, array.buffer());
}

void CellCompute::bind(GLuint binding, const DeviceArray& array, std::size_t first,
                       std::size_t count) const {
    gl_->BindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, array.buffer(),
                         static_cast<GLintptr>(first * array.element_bytes()),
                         static_cast<GLsizeiptr>(count * array.element_bytes()));
}

template <class Prepare>
void CellCompute::run(const LazyProgram& program, DrawPart items, Work work, Prepare&& prepare) const {
    static_assert(sizeof(Work) == 32 + 4 * index::kMostSurfaces && index::kMostSurfaces % 4 == 0);
    gl_->UseProgram(program.name());
    std::size_t begin = items.first;
    const std::size_t all = items.first + items.count;
    do { // runs also for no items: drivers compile programs when they first run
        const std::size_t end = std::min(begin + at_once_, all);
        work.begin = static_cast<std::uint32_t>(begin);
        work.end = static_cast<std::uint32_t>(end);
        gl_->NamedBufferData(work_.name(), sizeof(work), &work, GL_STREAM_DRAW);
        gl_->BindBufferBase(GL_UNIFORM_BUFFER, 1, work_.name());
        prepare(begin, end);
        const std::size_t groups =
            std::max((end - begin + kWorkGroup - 1) / kWorkGroup, std::size_t{1});
        gl_->DispatchCompute(static_cast<GLuint>(groups), 1, 1);
        begin = end;
    } while (begin < all);
    gl_->UseProgram(0);
    gl_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                       GL_BUFFER_UPDATE_BARRIER_BIT);
}

void CellCompute::enter_pages(const BlockPool& blocks) const {
    bind(0, blocks.pages());
    bind(1, blocks.page_message());
    run(pages_, blocks.page_changes(), {}, [](std::size_t, std::size_t) {});
}

void CellCompute::place_cells(const SlotAssignment& assignment, const index::Extraction& set,
                              const DeviceArray& message, const DeviceArray& points) const {
    const auto cells = grid_.cells();
    Work work{.whole = assignment.whole(), .cells = {cells[0], cells[1]}};
    std::uint32_t end = 0;
    for (std::size_t i = 0; i < work.surface_ends.size(); ++i)
        work.surface_ends[i] = end +=
            i < set.surfaces.size() ? std::uint32_t(set.surfaces[i].ids.size()) : 0;
    bind(0, points);
    bind(1, message);
    run(places_, assignment.ids(), work, [](std::size_t, std::size_t) {});
}

void CellCompute::set_styles(const index::Extraction& set, const DeviceArray& styles,
                             const DeviceArray& points) const {
    bind(0, points);
    bind(1, styles);
    run(styles_, set.cells(), {.colored = !set.colors.empty()}, [](std::size_t, std::size_t) {});
}

void CellCompute::fill_planes(const index::Extraction& set, const BlockPool& blocks,
                              const DeviceArray& points) const {
    use_volume(set, blocks);
    bind(0, points);
    run(planes_, set.cells(), {}, [](std::size_t, std::size_t) {});
}

void CellCompute::fill_corners(const index::Extraction& set, const BlockPool& blocks,
                               const DeviceArray& points, DrawPart cells, const Corners& to) const {
    use_volume(set, blocks);
    bind(0, points);
    gl_->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, to.list != 0 ? to.list : points.buffer());
    run(corners_, cells, {.whole = to.list == 0}, [&](std::size_t begin, std::size_t end) {
        const std::size_t count =
            std::max(end - begin, std::size_t{1}); // a range must not be empty
        bind(1, to.values, begin - to.first, count);
        bind(2, to.gradients, begin - to.first, count);
    });
}

} // namespace isochron::render
