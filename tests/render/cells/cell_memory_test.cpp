// Sets for which the driver has no memory are refused, and the last one stays.
#include "tests/render/cells/cell_upload.h"

#include <limits>
#include <utility>

namespace isochron::render {
namespace {

GLsizeiptr memory_left = 0;
bool ran_out = false;
PFNGLNAMEDBUFFERDATAPROC real_buffer_data = nullptr;
PFNGLGETERRORPROC real_error = nullptr;

/// Gives a buffer no more than `memory_left`, and then nothing, like a full GPU.
void APIENTRY little_memory(GLuint buffer, GLsizeiptr bytes, const void* data, GLenum usage) {
    if (bytes > memory_left)
        ran_out = true;
    else
        real_buffer_data(buffer, bytes, data, usage);
}
GLenum APIENTRY error_of_memory() {
    return std::exchange(ran_out, false) ? GL_OUT_OF_MEMORY : real_error();
}

class CellMemory : public CellUploadTest {
  protected:
    CellMemory() {
        real_buffer_data = gl_.NamedBufferData;
        real_error = gl_.GetError;
        gl_.NamedBufferData = little_memory;
        gl_.GetError = error_of_memory;
        memory_left = std::numeric_limits<GLsizeiptr>::max();
        ran_out = false;
    }
};

TEST_P(CellMemory, ASetWithoutMemoryIsRefusedTheLastOneStaysAndALaterOneIsShown) {
    const auto fits = random_set(300), next = random_set(300);
    const auto too_many = extractions_.shaded(random_set(6000));
    for (const bool staged : {false, true}) {
        SCOPED_TRACE(staged);
        memory_left = std::numeric_limits<GLsizeiptr>::max();
        CellBuffers buffers(gl_, field_.view().grid);
        ASSERT_TRUE(buffers.upload(fits, kEnough));
        const auto before = drawn(buffers);
        memory_left = 60'000; // less than 6000 cells take
        for (int frame = 0; frame < 3; ++frame) {
            if (staged) {
                EXPECT_TRUE(buffers.stage(too_many, kEnough)) << "nothing is left to send";
            }
            EXPECT_FALSE(buffers.upload(too_many, kEnough));
            EXPECT_EQ(buffers.shown(), fits);
            EXPECT_EQ(buffers.refused(), too_many);
            EXPECT_TRUE(buffers.refusal().ends_with(", so the last cells stay"))
                << buffers.refusal();
            EXPECT_FALSE(buffers.pending());
            EXPECT_EQ(drawn(buffers), before);
        }
        memory_left = std::numeric_limits<GLsizeiptr>::max();
        EXPECT_TRUE(buffers.upload(next, kEnough));
        EXPECT_EQ(buffers.refused(), nullptr);
        EXPECT_TRUE(buffers.has_volume());
        expect_whole(buffers);
        EXPECT_TRUE(buffers.upload(too_many, kEnough));
        expect_whole(buffers);
    }
}

INSTANTIATE_TEST_SUITE_P(, CellMemory, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
