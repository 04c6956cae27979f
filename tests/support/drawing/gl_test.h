// Fixture of tests that draw: both windowless contexts; every GL error is a failure.
#pragma once

#include "render/cells/cell_buffers.h"
#include "render/gl/gl.h"
#include "stereo/context/gl_context.h"

#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

namespace isochron::render {

class GlTest : public testing::TestWithParam<stereo::ContextKind> {
  protected:
    GlTest()
        : context_(stereo::make_context(GetParam(), {.size = {16, 16}})), gl_(context_->loader()) {
        gl_.Enable(GL_DEBUG_OUTPUT);
        gl_.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        gl_.DebugMessageCallback(
            [](GLenum source, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message,
               const void*) {
                if (source != GL_DEBUG_SOURCE_SHADER_COMPILER && // its log reports errors
                    (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR))
                    ADD_FAILURE() << "GL error: " << message;
            },
            nullptr);
    }
    void TearDown() override { EXPECT_EQ(gl_.GetError(), GLenum{GL_NO_ERROR}); }

    /// Lets the time of a frame pass: until the GPU has done all of its work.
    void let_a_frame_pass() { gl_.Finish(); }

    std::unique_ptr<stereo::GlContext> context_;
    Gl gl_;
    const unsigned seed_ = test_seed();
    testing::ScopedTrace trace_{__FILE__, __LINE__, "seed " + std::to_string(seed_)};
    std::mt19937 random_{seed_};
};

inline auto both_contexts() {
    return testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa);
}
inline std::string context_name(const testing::TestParamInfo<stereo::ContextKind>& info) {
    return std::string(stereo::name_of(info.param));
}

/// Points of cells that all have the same packed normal.
inline std::vector<index::CellPoint> cell_set(const std::vector<glm::ivec3>& cells,
                                              std::uint32_t normal = 0) {
    std::vector<index::CellPoint> points;
    for (const glm::ivec3& cell : cells)
        points.push_back(
            {std::uint16_t(cell.x), std::uint16_t(cell.y), std::uint16_t(cell.z), 0, normal});
    return points;
}

/// Packs a plane. @param offset from the cell's middle [voxel]
inline std::uint32_t packed_normal(const glm::vec3& n, double offset = 0.0) {
    return index::pack({glm::dvec3(n), offset});
}

/// Buffers that hold these cells.
inline CellBuffers showing(const Gl& gl, const std::vector<index::CellPoint>& points) {
    return CellBuffers::of_points(gl, points);
}

} // namespace isochron::render
