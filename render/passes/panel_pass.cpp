// Uniforms and GL state for drawing a panel.
#include "render/passes/panel_pass.h"

#include "render/gl/soft_edges.h"
#include "render/gl/viewport.h"

#include <glm/geometric.hpp>

namespace isochron::render {
namespace {

constexpr float kDot = 0.0065f; ///< [m] radius

} // namespace

bool hides(const PanelQuad& panel, const glm::vec3& eye, const glm::vec3& point) {
    const glm::vec3& corner = panel.corners[0];
    const glm::vec3 across = panel.corners[3] - corner, up = panel.corners[1] - corner;
    const glm::vec3 normal = glm::cross(across, up);
    const float from_eye = glm::dot(eye - corner, normal);
    const float from_point = glm::dot(point - corner, normal);
    if ((from_eye > 0.0f) == (from_point > 0.0f))
        return false;
    const glm::vec3 at = glm::mix(eye, point, from_eye / (from_eye - from_point)) - corner;
    const float x = glm::dot(at, across) / glm::dot(across, across);
    const float y = glm::dot(at, up) / glm::dot(up, up);
    return x >= 0.0f && x <= 1.0f && y >= 0.0f && y <= 1.0f;
}

PanelPass::PanelPass(const Gl& gl)
    : program_(gl, {shader_file("picture.vert"), shader_file("room_panel.frag")}),
      no_attributes_(gl) {}

void PanelPass::draw(const View& view, const PanelQuad& panel) const {
    const Gl& gl = program_.gl();
    const GLuint program = program_.name();
    const auto place = [&](const char* name) { return gl.GetUniformLocation(program, name); };
    const glm::mat4 clip_from_room = view.clip_from_eye * view.eye_from_room;
    const auto& corners = panel.corners;
    const glm::vec2 size(glm::distance(corners[0], corners[3]),
                         glm::distance(corners[0], corners[1]));
    const glm::vec2 reach = kDot / size;
    set_viewport(gl, view);
    gl.UseProgram(program);
    gl.ProgramUniformMatrix4fv(program, place("clip_from_room"), 1, GL_FALSE,
                               &clip_from_room[0][0]);
    gl.ProgramUniform3fv(program, place("corners"), 4, &corners[0].x);
    if (panel.dot) // pictures have their first row at the bottom
        gl.ProgramUniform4f(program, place("pointed"), panel.dot->x, 1.0f - panel.dot->y, reach.x,
                            reach.y);
    else
        gl.ProgramUniform4f(program, place("pointed"), 0.0f, 0.0f, 0.0f, 0.0f);
    gl.BindTextureUnit(0, panel.texture);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.Disable(GL_CULL_FACE);
    gl.BindVertexArray(no_attributes_.name());
    blend_over(gl);
    draw_colors_then_depth(gl, true, [&](bool depth_only) {
        constexpr float kCore = 0.5f;
        gl.ProgramUniform1f(program, place("core"), depth_only ? kCore : 0.0f);
        gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    });
    gl.Disable(GL_BLEND);
    gl.UseProgram(0);
}

} // namespace isochron::render
