// Packing of corner values and gradients.
#include "tests/render/corner_buffers.h"

#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace isochron::render {

CornerBuffers::CornerBuffers(const Gl& gl, const VertexField& field, const index::CellSet& set)
    : values_(gl), gradients_(gl), values_texture_(gl, GL_TEXTURE_BUFFER),
      gradients_texture_(gl, GL_TEXTURE_BUFFER) {
    double steepest = 0.0;
    const auto each_corner = [&](const auto& visit) {
        for (const index::CellPoint& point : set.points)
            for (int corner = 0; corner < 8; ++corner)
                visit(glm::ivec3(point.x, point.y, point.z) + corner_of_cell(corner));
    };
    each_corner([&](glm::ivec3 vertex) {
        steepest = std::max(steepest, glm::length(field.gradient(vertex)));
    });
    std::vector<float> values;
    std::vector<std::uint32_t> gradients;
    each_corner([&](glm::ivec3 vertex) {
        values.push_back(static_cast<float>(field.value(vertex)));
        const glm::vec3 g(field.gradient(vertex) / std::max(steepest, 1e-300));
        gradients.push_back(glm::packHalf2x16({g.x, g.y}));
        gradients.push_back(glm::packHalf2x16({g.z, 0.0f}));
    });
    const auto send = [&](const Texture& texture, const Buffer& buffer, GLenum format,
                          const auto& data) {
        gl.NamedBufferData(buffer.name(), std::ssize(data) * sizeof(data[0]), data.data(),
                           GL_STATIC_DRAW);
        gl.TextureBuffer(texture.name(), format, buffer.name());
    };
    send(values_texture_, values_, GL_RGBA32F, values);
    send(gradients_texture_, gradients_, GL_RGBA32UI, gradients);
}

} // namespace isochron::render
