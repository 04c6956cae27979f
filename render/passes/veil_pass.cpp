// Darkens a view by one triangle that covers it.
#include "render/passes/veil_pass.h"

#include "render/gl/soft_edges.h"
#include "render/gl/viewport.h"

namespace isochron::render {

VeilPass::VeilPass(const Gl& gl)
    : gl_(&gl),
      program_(gl, {shader_file("full_screen.vert"), shader_file("veil.frag")}),
      no_attributes_(gl) {}

void VeilPass::draw(const View& view, const Veil& veil) const {
    if (veil == Veil{})
        return;
    const glm::vec2 corner(view.corner), size(view.size);
    set_viewport(*gl_, view);
    gl_->ProgramUniform4f(program_.name(), 0, corner.x, corner.y, size.x, size.y);
    gl_->ProgramUniform2f(program_.name(), 1, veil.whole, veil.rim);
    gl_->Disable(GL_DEPTH_TEST);
    blend_over(*gl_);
    gl_->UseProgram(program_.name());
    gl_->BindVertexArray(no_attributes_.name());
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    gl_->BindVertexArray(0);
    gl_->UseProgram(0);
    gl_->Disable(GL_BLEND);
    gl_->Enable(GL_DEPTH_TEST);
}

} // namespace isochron::render
