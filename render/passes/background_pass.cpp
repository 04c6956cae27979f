// One triangle behind all else.
#include "render/passes/background_pass.h"

#include "render/gl/srgb.h"
#include "render/gl/viewport.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace isochron::render {

BackgroundPass::BackgroundPass(const Gl& gl)
    : gl_(&gl),
      program_(gl, {shader_file("full_screen.vert"), shader_file("background.frag")}),
      no_attributes_(gl) {}

void BackgroundPass::draw(const View& view, const BackgroundColors& colors) const {
    const glm::vec2 corner(view.corner), size(view.size);
    // The ray through a place of the picture, -1 to 1 across and up, is x right + y up + ahead.
    const glm::mat4 eye_from_clip = glm::inverse(view.clip_from_eye);
    const glm::mat3 room_from_eye = glm::inverse(glm::mat3(view.eye_from_room));
    const auto far_end = [&](float x, float y) {
        const glm::vec4 at = eye_from_clip * glm::vec4(x, y, 1.0f, 1.0f);
        return room_from_eye * (glm::vec3(at) / at.w);
    };
    glm::vec3 ahead = far_end(0.0f, 0.0f);
    glm::vec3 right = far_end(1.0f, 0.0f) - ahead, up = far_end(0.0f, 1.0f) - ahead;
    if (view.is_parallel()) { // one direction; the picture is a window on the sky all the same
        ahead = room_from_eye * glm::vec3(0.0f, 0.0f, -1.0f);
        right = room_from_eye * glm::vec3(0.5f, 0.0f, 0.0f);
        up = room_from_eye * glm::vec3(0.0f, 0.5f, 0.0f);
    }
    const glm::vec3 low = linear_from_srgb(colors.low), high = linear_from_srgb(colors.high);
    const GLuint program = program_.name();
    set_viewport(*gl_, view);
    gl_->ProgramUniform4f(program, 0, corner.x, corner.y, size.x, size.y);
    gl_->ProgramUniform3f(program, 1, right.y, up.y, ahead.y);
    gl_->ProgramUniform3f(program, 2, right.x, right.y, right.z);
    gl_->ProgramUniform3f(program, 3, up.x, up.y, up.z);
    gl_->ProgramUniform3f(program, 4, ahead.x, ahead.y, ahead.z);
    gl_->ProgramUniform3f(program, 5, low.x, low.y, low.z);
    gl_->ProgramUniform3f(program, 6, high.x, high.y, high.z);
    gl_->Disable(GL_DEPTH_TEST);
    gl_->DepthMask(GL_FALSE);
    gl_->Disable(GL_BLEND);
    gl_->UseProgram(program);
    gl_->BindVertexArray(no_attributes_.name());
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    gl_->BindVertexArray(0);
    gl_->UseProgram(0);
    gl_->DepthMask(GL_TRUE);
    gl_->Enable(GL_DEPTH_TEST);
}

} // namespace isochron::render
