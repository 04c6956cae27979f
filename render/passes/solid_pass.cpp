// Models of triangles, and buffers and GL state for drawing them.
#include "render/passes/solid_pass.h"

#include "render/gl/viewport.h"

#include <glm/gtc/constants.hpp>
#include <glm/vec4.hpp>

#include <cmath>

namespace isochron::render {
namespace {

void add_quad(std::vector<Triangle>& into, const std::array<glm::vec3, 4>& corners,
              glm::vec3 color) {
    into.push_back({{corners[0], corners[1], corners[2]}, color});
    into.push_back({{corners[0], corners[2], corners[3]}, color});
}

} // namespace

std::vector<Triangle> ellipsoid(glm::vec3 center, glm::vec3 radii, glm::vec3 color) {
    constexpr int kRings = 12, kSectors = 20;
    const auto point = [&](int ring, int sector) {
        const float polar = glm::pi<float>() * float(ring) / kRings;
        const float turn = glm::two_pi<float>() * float(sector) / kSectors;
        return center + radii * glm::vec3(std::sin(polar) * std::sin(turn), std::cos(polar),
                                          std::sin(polar) * std::cos(turn));
    };
    std::vector<Triangle> triangles;
    for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector)
            add_quad(triangles,
                     {point(ring, sector), point(ring + 1, sector), point(ring + 1, sector + 1),
                      point(ring, sector + 1)},
                     color);
    return triangles;
}

std::vector<Triangle> solid_box(glm::vec3 low, glm::vec3 high, glm::vec3 color) {
    std::vector<Triangle> triangles;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool far : {false, true}) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            std::array<glm::vec3, 4> corners;
            for (int i = 0; i < 4; ++i) {
                const bool along_u = i == 1 || i == 2, along_v = i >= 2;
                // The near side is seen from the other direction, so reverse its corners.
                corners[far ? i : 3 - i][axis] = far ? high[axis] : low[axis];
                corners[far ? i : 3 - i][u] = along_u ? high[u] : low[u];
                corners[far ? i : 3 - i][v] = along_v ? high[v] : low[v];
            }
            add_quad(triangles, corners, color);
        }
    return triangles;
}

std::vector<Triangle> pyramid(const std::array<glm::vec3, 4>& base, glm::vec3 tip,
                              glm::vec3 color) {
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < base.size(); ++i)
        triangles.push_back({{base[i], base[(i + 1) % base.size()], tip}, color});
    return triangles;
}

SolidPass::SolidPass(const Gl& gl)
    : program_(gl, {shader_file("solid.vert"), shader_file("solid.frag")}),
      no_attributes_(gl), corners_(gl, "triangles", 4) {}

void SolidPass::draw(const View& view, const glm::mat4& room_from_model,
                     std::span<const Triangle> triangles) {
    const Gl& gl = program_.gl();
    std::vector<glm::vec4> data;
    data.reserve(4 * triangles.size());
    for (const Triangle& triangle : triangles) {
        for (const glm::vec3& corner : triangle.corners)
            data.emplace_back(corner, 1.0f);
        data.emplace_back(triangle.color, 1.0f);
    }
    corners_.set(std::as_bytes(std::span(data)));
    const GLuint program = program_.name();
    const auto matrix = [&](const char* name, const glm::mat4& value) {
        gl.ProgramUniformMatrix4fv(program, gl.GetUniformLocation(program, name), 1, GL_FALSE,
                                   &value[0][0]);
    };
    matrix("eye_from_model", view.eye_from_room * room_from_model);
    matrix("clip_from_eye", view.clip_from_eye);
    set_viewport(gl, view);
    gl.UseProgram(program);
    gl.BindTextureUnit(0, corners_.texture());
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.DepthMask(GL_TRUE);
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_BLEND);
    gl.BindVertexArray(no_attributes_.name());
    gl.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * triangles.size()));
}

} // namespace isochron::render
