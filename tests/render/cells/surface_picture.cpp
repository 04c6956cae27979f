// Draws surfaces into a float target, by shaders that write the normal instead of light.
#include "tests/render/cells/surface_picture.h"

#include <string>

namespace isochron::render {

namespace {

PFNGLSHADERSOURCEPROC plain_shader_source = nullptr;

void APIENTRY source_with_normals(GLuint shader, GLsizei, const GLchar* const* text,
                                  const GLint* length) {
    std::string changed(*text, std::size_t(*length));
    const auto give_back = [&](const char* function, const char* argument) {
        if (const std::size_t begin = changed.find(function); begin != std::string::npos)
            changed.insert(changed.find('{', begin) + 1,
                           std::string(" if (true) return ") + argument + ';');
    };
    give_back("vec3 shade(", "normal");
    give_back("vec3 written(", "light");
    // A layer covers as it does with light.
    const std::string lit = "layer_of(base_at(p), lit, turned, base.a)";
    if (const std::size_t begin = changed.find(lit); begin != std::string::npos)
        changed.replace(begin, lit.size(), "vec4(normal, 1.0) * " + lit + ".a");
    const GLchar* data = changed.data();
    const auto size = static_cast<GLint>(changed.size());
    plain_shader_source(shader, 1, &data, &size);
}

Gl with_normals(const Gl& gl) {
    Gl changed = gl;
    plain_shader_source = gl.ShaderSource;
    changed.ShaderSource = source_with_normals;
    return changed;
}

} // namespace

Placement placed_at_origin(const index::Grid& grid, const glm::dmat4& room_from_physical) {
    const auto cells = grid.cells();
    const glm::dvec3 extent(cells[0], cells[1], cells[2]);
    const glm::dmat4 physical = grid.physical_from_index();
    const glm::dvec3 center(physical * glm::dvec4(0.5 * extent, 1.0));
    const double radius = 0.5 * glm::length(glm::dmat3(physical) * extent);
    return Placement::of(
        grid, glm::translate(glm::scale(room_from_physical, glm::dvec3(1.0 / radius)), -center));
}

SurfaceTest::SurfaceTest() : normals_gl_(with_normals(gl_)), pass_(normals_gl_) {}

SurfacePicture SurfaceTest::draw(CellPass& pass, const VertexField& field,
                                 const Placement& placement, std::span<const View> views,
                                 glm::ivec2 target_size, const CellAppearance& appearance) {
    const Texture color(gl_, GL_TEXTURE_2D), depth(gl_, GL_TEXTURE_2D);
    gl_.TextureStorage2D(color.name(), 1, GL_RGBA32F, target_size.x, target_size.y);
    gl_.TextureStorage2D(depth.name(), 1, GL_DEPTH_COMPONENT32F, target_size.x, target_size.y);
    const Framebuffer framebuffer(gl_);
    gl_.NamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, color.name(), 0);
    gl_.NamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
    constexpr glm::vec4 kNothing(0.0f);
    constexpr float kFarDepth = 1.0f;
    gl_.ClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, &kNothing.x);
    gl_.ClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &kFarDepth);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());

    CellBuffers cells(gl_, field.values().grid);
    const index::ExtractionPtr active =
        Extractions(field.values()).active(field.query().instant.step, {field.query().isovalue});
    while (cells.shown() != active) // a transfer goes as fast as the GPU takes it
        cells.upload(active, std::size_t{1} << 30);
    cells.compute_corners();
    pass.draw(views, placement, cells, Footprint::surface, appearance);

    SurfacePicture picture{.size = target_size, .depths = {}, .normals = {}};
    picture.depths.resize(std::size_t(target_size.x) * target_size.y);
    picture.normals.resize(picture.depths.size());
    gl_.ReadPixels(0, 0, target_size.x, target_size.y, GL_DEPTH_COMPONENT, GL_FLOAT,
                   picture.depths.data());
    gl_.ReadPixels(0, 0, target_size.x, target_size.y, GL_RGBA, GL_FLOAT, picture.normals.data());
    return picture;
}

} // namespace isochron::render
