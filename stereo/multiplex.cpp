// Composition of two eyes' pictures in a fragment shader.
#include "stereo/multiplex.h"

#include "render/gl/shader.h"

#include <algorithm>
#include <array>
#include <utility>

namespace isochron::stereo {
namespace {

/// The numbers by which multiplex.frag knows the modes.
constexpr std::array<std::pair<StereoMode, GLint>, 5> kShaderModes{{
    {StereoMode::anaglyph_red_cyan, 0},
    {StereoMode::anaglyph_dubois, 1},
    {StereoMode::vertical_interlaced, 2},
    {StereoMode::horizontal_interlaced, 3},
    {StereoMode::checkerboard, 4},
}};

const std::pair<StereoMode, GLint>* find(StereoMode mode) {
    return std::ranges::find(kShaderModes, upright(mode), &std::pair<StereoMode, GLint>::first);
}

} // namespace

Multiplex::Multiplex(const render::Gl& gl)
    : program_(render::link_program(
          gl, {render::shader_file("full_screen.vert"), render::shader_file("multiplex.frag")})),
      no_attributes_(gl) {}

bool Multiplex::shows(StereoMode mode) {
    return find(mode) != kShaderModes.end();
}

void Multiplex::draw(const EyePicture& left, const EyePicture& right, StereoMode mode,
                     glm::ivec2 corner, int window_height) const {
    const render::Gl& gl = program_.gl();
    for (const GLenum capability : {GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST})
        gl.Disable(capability);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    const GLuint program = program_.name();
    gl.UseProgram(program);
    gl.ProgramUniform1i(program, gl.GetUniformLocation(program, "mode"), find(mode)->second);
    const auto place = [&](const char* name, glm::ivec2 at) {
        gl.ProgramUniform2i(program, gl.GetUniformLocation(program, name), at.x, at.y);
    };
    place("left_from_window", left.corner - corner);
    place("right_from_window", right.corner - corner);
    gl.ProgramUniform1i(program, gl.GetUniformLocation(program, "window_height"), window_height);
    gl.BindTextureUnit(0, left.target->color_texture());
    gl.BindTextureUnit(1, right.target->color_texture());
    gl.BindVertexArray(no_attributes_.name());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace isochron::stereo
