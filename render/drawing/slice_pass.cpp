// Buffers and GL state for drawing slices.
#include "render/drawing/slice_pass.h"

#include "render/gl/srgb.h"
#include "render/gl/viewport.h"

#include <glm/vec4.hpp>

#include <algorithm>
#include <utility>

namespace isochron::render {
namespace {

/// Locations of slice.vert and slice.frag.
enum Uniform : GLint {
    clip_from_even = 0,
    corners = 1,
    cells = 8,
    axis,
    on_map,
    half_width,
    line_count,
    lines
};

static_assert(index::kNoShare / 2 == 1.5e38f, "slice.frag has it as MISSING");

} // namespace

SlicePass::SlicePass(const Gl& gl, const index::Grid& grid)
    : gl_(gl), grid_(grid),
      program_(gl, {shader_file("slice.vert"), shader_file("slice.frag")}, prelude_for(grid)),
      no_attributes_(gl), axes_(gl, grid) {}

void SlicePass::hold(std::span<const index::SliceValuesPtr> slices) {
    const auto wanted = [&](const index::SliceValuesPtr& values) {
        return std::ranges::find(slices, values) != slices.end();
    };
    std::erase_if(held_, [&](const Held& held) { return !wanted(held.values); });
    for (const index::SliceValuesPtr& slice : slices) {
        if (!slice || slice->shares.empty() ||
            std::ranges::find(held_, slice, &Held::values) != held_.end())
            continue;
        Held held{slice, BufferTexture(gl_), BufferTexture(gl_)};
        held.columns.set(GL_RG32UI, sizeof(index::SliceValues::Column),
                         std::as_bytes(std::span(slice->columns)));
        held.shares.set(GL_R32F, sizeof(float), std::as_bytes(std::span(slice->shares)));
        held_.push_back(std::move(held));
    }
}

void SlicePass::draw(const View& view, const glm::mat4& room_from_even,
                     const index::SliceValues& slice, const ValueColors& colors,
                     std::span<const Isoline> isolines, float width) {
    const auto held =
        std::ranges::find_if(held_, [&](const Held& each) { return each.values.get() == &slice; });
    if (held == held_.end())
        return;
    const GLuint program = program_.name();
    const glm::mat4 clip = view.clip_from_eye * view.eye_from_room * room_from_even;
    gl_.ProgramUniformMatrix4fv(program, clip_from_even, 1, GL_FALSE, &clip[0][0]);
    std::vector<glm::vec4> polygon;
    for (const glm::dvec3& corner : slice.outline)
        polygon.emplace_back(glm::vec3(corner), 1.0f);
    gl_.ProgramUniform4fv(program, corners, static_cast<GLsizei>(polygon.size()), &polygon[0].x);
    const auto count = grid_.cells();
    gl_.ProgramUniform3f(program, cells, static_cast<float>(count[0]), static_cast<float>(count[1]),
                         static_cast<float>(count[2]));
    gl_.ProgramUniform1i(program, axis, slice.axis);
    const float scale = 1.0f / std::max(colors.high - colors.low, 1e-30f);
    gl_.ProgramUniform4f(program, on_map, scale, -colors.low * scale, colors.ratio,
                         colors.bands ? 1.0f : 0.0f);
    gl_.ProgramUniform1f(program, half_width, 0.5f * width);
    std::vector<glm::vec4> drawn;
    for (const Isoline& line : isolines)
        drawn.emplace_back(linear_from_srgb(line.color), line.share);
    gl_.ProgramUniform1i(program, line_count, static_cast<GLint>(drawn.size()));
    if (!drawn.empty())
        gl_.ProgramUniform4fv(program, lines, static_cast<GLsizei>(drawn.size()), &drawn[0].x);
    set_viewport(gl_, view);
    gl_.UseProgram(program);
    gl_.BindTextureUnit(0, held->columns.texture());
    gl_.BindTextureUnit(1, held->shares.texture());
    gl_.BindTextureUnit(7, colors.map);
    axes_.bind();
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LESS);
    gl_.DepthMask(GL_TRUE);
    gl_.Disable(GL_CULL_FACE);
    gl_.Disable(GL_BLEND);
    gl_.BindVertexArray(no_attributes_.name());
    gl_.DrawArrays(GL_TRIANGLE_FAN, 0, static_cast<GLsizei>(polygon.size()));
    gl_.BindVertexArray(0);
    gl_.UseProgram(0);
}

} // namespace isochron::render
