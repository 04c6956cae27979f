// GL state for drawing a textured rectangle.
#include "render/passes/picture_pass.h"

#include "render/gl/soft_edges.h"
#include "render/gl/viewport.h"

namespace isochron::render {

PicturePass::PicturePass(const Gl& gl)
    : program_(gl, {shader_file("picture.vert"), shader_file("picture.frag")}),
      no_attributes_(gl) {}

void PicturePass::draw(const View& view, const std::array<glm::vec3, 4>& corners, GLuint texture,
                       float opacity) const {
    const Gl& gl = program_.gl();
    const GLuint program = program_.name();
    const glm::mat4 clip_from_room = view.clip_from_eye * view.eye_from_room;
    set_viewport(gl, view);
    gl.UseProgram(program);
    gl.ProgramUniformMatrix4fv(program, gl.GetUniformLocation(program, "clip_from_room"), 1,
                               GL_FALSE, &clip_from_room[0][0]);
    gl.ProgramUniform3fv(program, gl.GetUniformLocation(program, "corners"), 4, &corners[0].x);
    gl.ProgramUniform1f(program, gl.GetUniformLocation(program, "opacity"), opacity);
    gl.BindTextureUnit(0, texture);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.DepthMask(opacity < 1.0f ? GL_FALSE : GL_TRUE);
    gl.Disable(GL_CULL_FACE);
    blend_over(gl);
    gl.BindVertexArray(no_attributes_.name());
    gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl.Disable(GL_BLEND);
    gl.DepthMask(GL_TRUE);
}

} // namespace isochron::render
