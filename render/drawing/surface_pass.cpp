// Programs and GL state for drawing cells by ray casting.
#include "render/drawing/surface_pass.h"

namespace isochron::render {

SurfacePass::SurfacePass(const Gl& gl, bool two_views_at_once, const std::string& grid_prelude)
    : gl_(&gl) {
    const std::vector sources{shader_file("surface.vert"), shader_file("surface.frag")};
    for (const bool colored : {false, true})
        for (const bool each_sample : {false, true})
            for (const bool blended : {false, true})
                for (const bool two : {false, true})
                    if (!two || two_views_at_once)
                        programs_[colored][each_sample][blended][two].emplace(
                            gl, sources,
                            grid_prelude + std::string(two ? kTwoEyes : "") +
                                (blended ? "#define BLENDED\n" : "") +
                                (each_sample ? "#define EACH_SAMPLE\n" : "") +
                                (colored ? "#define COLORS\n" : ""));
}

void SurfacePass::draw(const QuadIndices& quads, const Corners& corners, bool blended,
                       std::size_t views, DrawPart part) const {
    gl_->BindTextureUnit(3, corners.values);
    gl_->BindTextureUnit(4, corners.gradients);
    const bool colored = corners.colors != 0;
    if (colored)
        gl_->BindTextureUnit(8, corners.colors);
    GLint samples = 0;
    gl_->GetIntegerv(GL_SAMPLES, &samples); // samples of the target
    gl_->UseProgram(programs_[colored][samples > 1][blended][views - 1]->name());
    quads.draw(part.count, static_cast<int>(views), part.first);
}

} // namespace isochron::render
