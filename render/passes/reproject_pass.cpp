// Draws a picture that was drawn for other eyes, moved by its depth.
#include "render/passes/reproject_pass.h"

#include "render/gl/viewport.h"
#include "render/passes/pixel_box.h"

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace isochron::render {
namespace {

/// Pixels of the target and depths of 0 to 1 from clip space, homogeneous.
glm::dmat4 pixels_from_clip(const View& view) {
    const glm::dvec3 half(0.5 * glm::dvec2(view.size), 0.5);
    const glm::dvec3 middle(glm::dvec2(view.corner) + glm::dvec2(half), 0.5);
    return glm::scale(glm::translate(glm::dmat4(1), middle), half);
}

glm::dmat4 pixels_from_box(const View& view, const glm::mat4& room_from_box) {
    return pixels_from_clip(view) * glm::dmat4(view.clip_from_eye) *
           glm::dmat4(view.eye_from_room) * glm::dmat4(room_from_box);
}

/// Depths between which all of the box lies.
glm::vec2 depths_of_box(const glm::dmat4& pixels) {
    glm::dvec2 range(1, 0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 at = pixels * glm::dvec4(corner & 1, corner >> 1 & 1, corner >> 2, 1);
        const double depth = at.w > 0 ? at.z / at.w : 0;
        range = {glm::min(range.x, depth), glm::max(range.y, depth)};
    }
    return glm::clamp(range, 0.0, 1.0);
}

} // namespace

ReprojectPass::ReprojectPass(const Gl& gl)
    : gl_(&gl),
      program_(gl, {shader_file("full_screen.vert"), shader_file("reproject.frag")}),
      no_attributes_(gl) {}

void ReprojectPass::draw(const View& view, const PictureWithDepth& picture,
                         const glm::mat4& room_from_box) const {
    const glm::dmat4 then = pixels_from_box(picture.view, picture.room_from_box);
    const glm::mat4 now_from_then(pixels_from_box(view, room_from_box) * glm::inverse(then));
    const glm::vec2 range = depths_of_box(then);
    const glm::vec2 least(picture.view.corner), size(picture.view.size);
    const GLuint program = program_.name();
    gl_->ProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, &now_from_then[0][0]);
    gl_->ProgramUniform4f(program, 4, least.x + 0.5f, least.y + 0.5f, least.x + size.x - 0.5f,
                          least.y + size.y - 0.5f);
    gl_->ProgramUniform2f(program, 5, range.x, range.y);
    set_viewport(*gl_, view);
    const PixelBox box = pixel_box(view, room_from_box);
    gl_->ScissorIndexed(0, box.low.x, box.low.y, box.high.x - box.low.x, box.high.y - box.low.y);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    gl_->DepthMask(GL_TRUE);
    gl_->Disable(GL_BLEND);
    gl_->BindTextureUnit(0, picture.color);
    gl_->BindTextureUnit(1, picture.depth);
    gl_->UseProgram(program);
    gl_->BindVertexArray(no_attributes_.name());
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    gl_->BindVertexArray(0);
    gl_->UseProgram(0);
    set_viewport(*gl_, view);
}

} // namespace isochron::render
