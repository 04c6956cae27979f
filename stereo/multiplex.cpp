// Combines two eyes' pictures in a fragment shader.
#include "stereo/multiplex.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace isochron::stereo {
namespace {

/// The modes that multiplex.frag composes.
constexpr std::array kShown{StereoMode::anaglyph_red_cyan, StereoMode::anaglyph_dubois,
                            StereoMode::vertical_interlaced, StereoMode::horizontal_interlaced,
                            StereoMode::checkerboard};

GLint number_in_shader(StereoMode mode) {
    return static_cast<GLint>(upright(mode));
}

} // namespace

Multiplex::Multiplex(const render::Gl& gl)
    : program_(gl, {render::shader_file("full_screen.vert"), render::shader_file("multiplex.frag")},
               shader_prelude()),
      no_attributes_(gl) {}

std::string Multiplex::shader_prelude() {
    std::string prelude;
    for (const StereoMode mode : kShown)
        prelude += fmt::format("#define {} {}\n", name_of(mode), number_in_shader(mode));
    return prelude;
}

bool Multiplex::shows(StereoMode mode) {
    return std::ranges::find(kShown, upright(mode)) != kShown.end();
}

void Multiplex::draw(const EyePicture& left, const EyePicture& right, StereoMode mode,
                     glm::ivec2 corner, int window_height, bool upside_down) const {
    const render::Gl& gl = program_.gl();
    for (const GLenum capability : {GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST})
        gl.Disable(capability);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    const GLuint program = program_.name();
    gl.UseProgram(program);
    gl.ProgramUniform1i(program, gl.GetUniformLocation(program, "mode"), number_in_shader(mode));
    const auto place = [&](const char* name, glm::ivec2 at) {
        gl.ProgramUniform2i(program, gl.GetUniformLocation(program, name), at.x, at.y);
    };
    // A turned picture begins with its last pixel, and goes backwards.
    const auto begin = [&](const EyePicture& eye) {
        return upside_down ? eye.corner + eye.size - 1 + corner : eye.corner - corner;
    };
    place("left_from_window", begin(left));
    place("right_from_window", begin(right));
    gl.ProgramUniform1i(program, gl.GetUniformLocation(program, "way"), upside_down ? -1 : 1);
    gl.ProgramUniform1i(program, gl.GetUniformLocation(program, "window_height"), window_height);
    gl.BindTextureUnit(0, left.target->color_texture());
    gl.BindTextureUnit(1, right.target->color_texture());
    gl.BindVertexArray(no_attributes_.name());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace isochron::stereo
