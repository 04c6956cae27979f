// Composition of the red-cyan picture in a fragment shader.
#include "stereo/anaglyph.h"

#include "render/shader.h"

namespace isochron::stereo {

Anaglyph::Anaglyph(const render::Gl& gl)
    : program_(render::link_program(
          gl, {render::shader_file("full_screen.vert"), render::shader_file("anaglyph.frag")})),
      no_attributes_(gl) {}

void Anaglyph::draw(const render::RenderTarget& left, const render::RenderTarget& right,
                    glm::ivec2 corner) const {
    const render::Gl& gl = program_.gl();
    for (const GLenum capability : {GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST})
        gl.Disable(capability);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.UseProgram(program_.name());
    gl.ProgramUniform2i(program_.name(), gl.GetUniformLocation(program_.name(), "corner"), corner.x,
                        corner.y);
    gl.BindTextureUnit(0, left.color_texture());
    gl.BindTextureUnit(1, right.color_texture());
    gl.BindVertexArray(no_attributes_.name());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace isochron::stereo
