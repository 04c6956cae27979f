// The staging ring: bytes arrive, room is never given out twice, and it never waits.
#include "render/gl/staging_ring.h"
#include "tests/support/drawing/gl_test.h"

#include <algorithm>
#include <cstring>

namespace isochron::render {
namespace {

/// Stands in for a GPU that is far behind: no fence is passed while it holds.
bool behind = false;
PFNGLCLIENTWAITSYNCPROC real_wait = nullptr;
GLuint64 longest_wait = 0;
GLenum APIENTRY wait_sync(GLsync sync, GLbitfield flags, GLuint64 timeout) {
    longest_wait = std::max(longest_wait, timeout);
    return behind ? GLenum{GL_TIMEOUT_EXPIRED} : real_wait(sync, flags, timeout);
}

class Staging : public GlTest {
  protected:
    Staging() {
        real_wait = gl_.ClientWaitSync;
        gl_.ClientWaitSync = wait_sync;
        behind = false;
        longest_wait = 0;
        gl_.NamedBufferData(target_.name(), kTarget, nullptr, GL_DYNAMIC_COPY);
    }
    std::vector<std::byte> random_bytes(std::size_t count) {
        std::vector<std::byte> bytes(count);
        for (std::byte& byte : bytes)
            byte = std::byte(random_());
        return bytes;
    }
    std::vector<std::byte> arrived(std::size_t count) {
        std::vector<std::byte> bytes(count);
        gl_.GetNamedBufferSubData(target_.name(), 0, GLsizeiptr(count), bytes.data());
        return bytes;
    }
    static constexpr std::size_t kTarget = 4096;
    Buffer target_{gl_};
};

TEST_P(Staging, BytesArriveWhateverTheirPortions) {
    StagingRing ring(gl_, 160);
    for (int round = 0; round < 30; ++round) {
        const auto bytes = random_bytes(1 + random_() % (kTarget - 1));
        std::size_t sent = 0;
        for (int tries = 0; sent < bytes.size(); ++tries) {
            ASSERT_LT(tries, 100'000);
            const std::size_t most = StagingRing::kUnit + random_() % 300;
            const std::size_t part =
                ring.send(std::span(bytes).subspan(sent), most, target_.name(), sent);
            ASSERT_LE(part, most);
            sent += part;
            if (random_() % 3 == 0)
                ring.end_frame();
            if (part == 0) {
                ring.end_frame();
                let_a_frame_pass();
            }
        }
        ASSERT_EQ(arrived(bytes.size()), bytes);
    }
    EXPECT_EQ(longest_wait, 0u);
}

TEST_P(Staging, AFullRingGivesNoRoomUntilTheGpuHasTakenWhatIsThere) {
    StagingRing ring(gl_, 64);
    const auto bytes = random_bytes(64);
    behind = true;
    std::size_t sent = 0;
    for (int frame = 0; frame < 5; ++frame) {
        sent += ring.send(std::span(bytes).first(48), 1000, target_.name(), sent);
        ring.end_frame();
    }
    EXPECT_EQ(sent, 64u);
    EXPECT_EQ(ring.send(bytes, 1000, target_.name(), 0), 0u);
    behind = false;
    let_a_frame_pass();
    EXPECT_GT(ring.send(bytes, 1000, target_.name(), 0), 0u);
    EXPECT_EQ(longest_wait, 0u) << "somebody waited";
}

INSTANTIATE_TEST_SUITE_P(, Staging, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
