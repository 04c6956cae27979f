// The driver's limits: their least values, missing ones, and work that is split by them.
#include "render/gl/limits.h"

#include "render/cells/cell_buffers.h"
#include "render/gl/render_target.h"
#include "render/gl/texel_buffer.h"
#include "tests/render/cells/cell_upload.h"
#include "tests/support/drawing/least_driver.h"

#include <cstring>
#include <string>
#include <vector>

namespace isochron::render {
namespace {

using test_support::least_limits;

class DriverLimits : public CellUploadTest {
  protected:
    /// The least driver, but for these.
    Gl driver_with(const std::map<GLenum, GLint64>& other = {}) {
        std::map<GLenum, GLint64> limits = least_limits();
        for (const auto& [name, value] : other)
            limits[name] = value;
        const auto replace = test_support::with_limits(limits);
        return Gl(
            [&, load = context_->loader()](const char* name) { return replace(name, load(name)); });
    }
    std::string complaint(const std::map<GLenum, GLint64>& other) {
        const Gl gl = driver_with(other);
        try {
            expect_enough(gl);
        } catch (const Error& error) {
            return error.what();
        }
        return "none";
    }
    std::vector<std::byte> bytes_of(GLuint texture, std::size_t count) {
        gl_.BindTextureUnit(0, texture);
        gl_.ActiveTexture(GL_TEXTURE0);
        GLint buffer = 0;
        gl_.GetIntegerv(GL_TEXTURE_BUFFER_DATA_STORE_BINDING, &buffer);
        std::vector<std::byte> bytes(count);
        gl_.GetNamedBufferSubData(GLuint(buffer), 0, GLsizeiptr(count), bytes.data());
        return bytes;
    }
    /// All that is computed of a set: cells, values and gradients at their corners.
    std::vector<std::vector<std::byte>> computed(const Gl& gl, const index::ExtractionPtr& set) {
        CellBuffers buffers(gl, field_.view().grid);
        while (buffers.shown() != set)
            buffers.upload(set, kEnough);
        buffers.compute_corners();
        const std::size_t cells = set->cells();
        return {bytes_of(buffers.texture(), cells * sizeof(index::CellPoint)),
                bytes_of(buffers.corner_values_texture(), cells * 32),
                bytes_of(buffers.corner_gradients_texture(), cells * 64)};
    }
};

TEST_P(DriverLimits, TheLeastThatGl45HasIsEnough) {
    EXPECT_NO_THROW(expect_enough(driver_with()));
    EXPECT_NO_THROW(expect_enough(gl_));
}

TEST_P(DriverLimits, WhatADriverLacksIsSaidInOneLine) {
    EXPECT_EQ(complaint({{GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 2}}),
              "GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS is 2 with this GL, at least 3 is needed");
    EXPECT_EQ(complaint({{GL_MAX_COMPUTE_WORK_GROUP_SIZE, 32}}),
              "GL_MAX_COMPUTE_WORK_GROUP_SIZE is 32 with this GL, at least 64 is needed");
    EXPECT_EQ(complaint({{GL_MAX_UNIFORM_BLOCK_SIZE, 512}}),
              "GL_MAX_UNIFORM_BLOCK_SIZE is 512 with this GL, at least 1280 is needed");
    EXPECT_EQ(complaint({{GL_MAX_VIEWPORTS, 1}}),
              "GL_MAX_VIEWPORTS is 1 with this GL, at least 2 is needed");
}

TEST_P(DriverLimits, CellsAreComputedInPartsThatTheDriverCanDo) {
    const auto set = random_set(2000);
    const auto expected = computed(gl_, set);
    const std::map<GLenum, GLint64> few_groups{{GL_MAX_COMPUTE_WORK_GROUP_COUNT, 5}};
    const std::map<GLenum, GLint64> small_blocks{{GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 40'000}};
    for (const auto& limits : {few_groups, small_blocks}) {
        const Gl gl = driver_with(limits);
        EXPECT_EQ(computed(gl, set), expected);
    }
}

TEST(WorkAtOnce, EndsWhereTheNextPartMayBegin) {
    static int nothing = 0;
    Gl gl([](const char*) -> void* { return &nothing; });
    gl.GetIntegerv = [](GLenum name, GLint* value) {
        if (name == GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT)
            *value = 96; // no power of two
    };
    gl.GetFloatv = [](GLenum, GLfloat*) {};
    gl.GetInteger64v = [](GLenum, GLint64* value) { *value = 1000 * 64; };
    gl.GetIntegeri_v = [](GLenum, GLuint, GLint* value) { *value = 65535; };
    EXPECT_EQ(work_at_once(Limits(gl), 64), 960u);
    gl.GetIntegeri_v = [](GLenum, GLuint, GLint* value) { *value = 2; };
    try {
        work_at_once(Limits(gl), 64);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "128 things at once on the GPU, at least 192 are needed: this "
                                   "GL has 2 work groups and 64000 bytes of a storage block");
    }
}

TEST_P(DriverLimits, ATargetThatOnlyATextureCouldHoldIsAnError) {
    for (const GLenum limit : {GL_MAX_VIEWPORT_DIMS, GL_MAX_RENDERBUFFER_SIZE}) {
        const Gl gl = driver_with({{limit, 512}});
        try {
            RenderTarget target(gl, {600, 4});
            FAIL() << "no error";
        } catch (const Error& error) {
            EXPECT_STREQ(error.what(), "render target: 600x4 pixels, this GL has 1x1 to 512x512");
        }
    }
}

TEST_P(DriverLimits, ADrawOfMoreThanABufferTextureHoldsIsAnError) {
    const Gl gl = driver_with();
    TexelBuffer lines(gl, "lines", 3);
    const std::vector<std::byte> bytes(std::size_t{21'846} * 3 * 16);
    lines.set(std::span(bytes).first(bytes.size() - 48));
    try {
        lines.set(bytes);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "21846 lines in one draw: this GL holds at most 21845");
    }
}

INSTANTIATE_TEST_SUITE_P(, DriverLimits, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
