// Tests of the drivers' promises.
#include "render/gl/driver_trials.h"

#include "render/gl/render_target.h"
#include "render/gl/shader.h"

#include <vector>

namespace isochron::render {

bool draws_to_two_viewports(const Gl& gl) {
    if (!has_extension(gl, kTwoEyesExtension))
        return false;
    const std::vector sources{shader_file("trial.vert"), shader_file("trial.frag")};
    const Program one = link_program(gl, sources), two = link_program(gl, sources, kTwoEyes);
    const VertexArray nothing(gl);
    const RenderTarget target(gl, {2, 1});
    target.clear({0, 0, 0, 1});
    target.bind();
    const auto draw = [&](const Program& program, int instances) {
        for (int i = 0; i < 2; ++i)
            gl.ViewportIndexedf(static_cast<GLuint>(i), static_cast<GLfloat>(i), 0, 1, 1);
        gl.UseProgram(program.name());
        gl.DrawArraysInstanced(GL_TRIANGLES, 0, 3, instances);
    };
    for (const GLenum state : {GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE})
        gl.Disable(state);
    gl.BindVertexArray(nothing.name());
    draw(one, 1);
    draw(two, 2);
    gl.BindVertexArray(0);
    gl.UseProgram(0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    const Image picture = target.read();
    // Only the second program, with two viewports, writes green.
    return picture.at(0, 0)[1] > 127 && picture.at(1, 0)[1] > 127;
}

bool passes_fences(const Gl& gl) {
    constexpr GLuint64 kSecond = 1'000'000'000;
    const GLsync fence = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    const GLenum state = gl.ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kSecond);
    gl.DeleteSync(fence);
    return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
}

} // namespace isochron::render
