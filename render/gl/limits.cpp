// Asks for the driver's limits, and compares them with the program's needs.
#include "render/gl/limits.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace isochron::render {
namespace {

GLint integer(const Gl& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

std::size_t count(const Gl& gl, GLenum name) {
    return static_cast<std::size_t>(std::max(integer(gl, name), 0));
}

GLint along_x(const Gl& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegeri_v(name, 0, &value);
    return value;
}

struct Need {
    const char* name;
    GLenum limit;
    GLint needed;
};
// clang-format off
#define NEED(limit, needed) Need{#limit, limit, needed}
// clang-format on
/// The needs of the shaders and passes; GL 4.5 core guarantees all of them.
constexpr std::array kNeeds{
    // surface.vert: cells, two orders, values and gradients at corners, the color map in unit 7.
    NEED(GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS, 6),
    NEED(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 8),
    NEED(GL_MAX_TEXTURE_IMAGE_UNITS, 2),         // multiplex.frag
    NEED(GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS, 2), // volume_blocks.glsl
    NEED(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 3),
    NEED(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, 3), // cell_corners.comp
    NEED(GL_MAX_VERTEX_UNIFORM_BLOCKS, 1),
    NEED(GL_MAX_FRAGMENT_UNIFORM_BLOCKS, 1),
    NEED(GL_MAX_COMPUTE_UNIFORM_BLOCKS, 2), // the volume, the work
    NEED(GL_MAX_UNIFORM_BUFFER_BINDINGS, 2),
    NEED(GL_MAX_UNIFORM_BLOCK_SIZE, kUniformBlockBytes),
    NEED(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, kWorkGroup),
    NEED(GL_MAX_VERTEX_ATTRIBS, 3),            // panel.vert
    NEED(GL_MAX_VARYING_VECTORS, 15),          // surface.glsl, with the eye
    NEED(GL_MAX_VERTEX_OUTPUT_COMPONENTS, 64), // these and the position
    NEED(GL_MAX_FRAGMENT_INPUT_COMPONENTS, 60),
    NEED(GL_MAX_TEXTURE_SIZE, 256), // a color map
    NEED(GL_MAX_VIEWPORTS, 2),      // both eyes in parts of one target
    NEED(GL_MAX_SAMPLES, 1),
};
#undef NEED

[[noreturn]] void lacks(const char* name, GLint needed, GLint got) {
    throw Error("{} is {} with this GL, at least {} is needed", name, got, needed);
}

void expect_size(const char* what, glm::ivec2 size, glm::ivec2 most) {
    if (size.x < 1 || size.y < 1 || size.x > most.x || size.y > most.y)
        throw Error("{}: {}x{} pixels, this GL has 1x1 to {}x{}", what, size.x, size.y, most.x,
                    most.y);
}

} // namespace

Limits::Limits(const Gl& gl)
    : texture_side(integer(gl, GL_MAX_TEXTURE_SIZE)),
      buffer_texels(count(gl, GL_MAX_TEXTURE_BUFFER_SIZE)),
      storage_alignment(
          std::max(count(gl, GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT), std::size_t{1})) {
    std::array<GLint, 2> viewport{};
    gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    const int side = std::min(texture_side, integer(gl, GL_MAX_RENDERBUFFER_SIZE));
    target = glm::min(glm::ivec2(viewport[0], viewport[1]), glm::ivec2(side));
    std::array<GLfloat, 2> points{};
    gl.GetFloatv(GL_POINT_SIZE_RANGE, points.data());
    largest_point = points[1];
    GLint64 bytes = 0;
    gl.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    storage_block_bytes = static_cast<std::size_t>(std::max<GLint64>(bytes, 0));
    work_groups =
        static_cast<std::size_t>(std::max(along_x(gl, GL_MAX_COMPUTE_WORK_GROUP_COUNT), 0));
}

void expect_enough(const Gl& gl) {
    for (const Need& need : kNeeds)
        if (const GLint got = integer(gl, need.limit); got < need.needed)
            lacks(need.name, need.needed, got);
    if (const GLint got = along_x(gl, GL_MAX_COMPUTE_WORK_GROUP_SIZE);
        got < static_cast<GLint>(kWorkGroup))
        lacks("GL_MAX_COMPUTE_WORK_GROUP_SIZE", kWorkGroup, got);
}

void expect_target(const Limits& limits, const char* what, glm::ivec2 size) {
    expect_size(what, size, limits.target);
}

void expect_texture(const Limits& limits, const char* what, glm::ivec2 size) {
    expect_size(what, size, glm::ivec2(limits.texture_side));
}

std::size_t work_at_once(const Limits& limits, std::size_t bytes) {
    // Any multiple of `unit` items takes a multiple of the alignment, whatever the bytes per item.
    const std::size_t unit = std::lcm(kWorkGroup, limits.storage_alignment);
    const std::size_t most =
        std::min(limits.work_groups * kWorkGroup, limits.storage_block_bytes / bytes);
    if (most < unit)
        throw Error("{} things at once on the GPU, at least {} are needed: this GL has {} work "
                    "groups and {} bytes of a storage block",
                    most, unit, limits.work_groups, limits.storage_block_bytes);
    return most / unit * unit;
}

} // namespace isochron::render
