// Transfer of cell sets: within its budget, never half a set, never starved.
#include "tests/render/gl_test.h"

#include <algorithm>

namespace isochron::render {
namespace {

constexpr std::size_t kCell = sizeof(index::CellPoint);
std::size_t sent_bytes = 0;
PFNGLNAMEDBUFFERSUBDATAPROC real_sub_data = nullptr;
void APIENTRY counting_sub_data(GLuint buffer, GLintptr offset, GLsizeiptr size, const void* data) {
    sent_bytes += size;
    real_sub_data(buffer, offset, size, data);
}

class CellUpload : public GlTest {
  protected:
    CellUpload() {
        real_sub_data = gl_.NamedBufferSubData;
        gl_.NamedBufferSubData = counting_sub_data;
        sent_bytes = 0;
    }
    index::CellSetPtr random_set(std::size_t cells) {
        std::vector<glm::ivec3> at(cells);
        for (glm::ivec3& cell : at)
            cell = {random_() % 1000, random_() % 1000, random_() % 1000};
        return cell_set(at, static_cast<std::uint32_t>(random_()));
    }
    /// What the GPU holds for the shown set is the shown set.
    void expect_whole(const CellBuffers& buffers) {
        const auto& points = buffers.shown()->points;
        gl_.BindTextureUnit(0, buffers.texture());
        GLint buffer = 0;
        gl_.ActiveTexture(GL_TEXTURE0);
        gl_.GetIntegerv(GL_TEXTURE_BUFFER_DATA_STORE_BINDING, &buffer);
        std::vector<index::CellPoint> held(points.size());
        if (!points.empty())
            gl_.GetNamedBufferSubData(buffer, 0, held.size() * kCell, held.data());
        EXPECT_TRUE(std::equal(points.begin(), points.end(), held.begin(),
                               [](const index::CellPoint& a, const index::CellPoint& b) {
                                   return a.x == b.x && a.y == b.y && a.z == b.z &&
                                          a.normal == b.normal;
                               }));
    }
};

TEST_P(CellUpload, StaysWithinTheBudgetAndShowsWholeSetsOnly) {
    CellBuffers buffers(gl_);
    const auto first = random_set(1000), second = random_set(777);
    ASSERT_TRUE(buffers.upload(first, 1000 * kCell));
    EXPECT_EQ(buffers.shown(), first);
    for (int frame = 0; frame < 8; ++frame) {
        sent_bytes = 0;
        const bool changed = buffers.upload(second, 100 * kCell + 5);
        EXPECT_LE(sent_bytes, 100 * kCell + 5);
        EXPECT_EQ(changed, frame == 7);
        EXPECT_EQ(buffers.shown(), frame == 7 ? second : first);
        EXPECT_EQ(buffers.pending(), frame != 7);
        expect_whole(buffers);
    }
    sent_bytes = 0;
    EXPECT_FALSE(buffers.upload(second, 1 << 20));
    EXPECT_EQ(sent_bytes, 0u);
}

TEST_P(CellUpload, FinishesWhatItBeganHoweverFastNewSetsArrive) {
    CellBuffers buffers(gl_);
    std::vector<index::CellSetPtr> sets;
    int changes = 0;
    for (int frame = 0; frame < 50; ++frame) {
        sets.push_back(random_set(300));
        changes += buffers.upload(sets.back(), 100 * kCell);
        if (buffers.shown())
            expect_whole(buffers);
    }
    EXPECT_EQ(changes, 16); // three frames each
    EXPECT_NE(std::find(sets.end() - 6, sets.end(), buffers.shown()), sets.end());
}

TEST_P(CellUpload, ABudgetOfNothingStillMovesOn) {
    CellBuffers buffers(gl_);
    const auto set = random_set(5);
    for (int frame = 0; frame < 4; ++frame)
        EXPECT_FALSE(buffers.upload(set, 0));
    EXPECT_TRUE(buffers.upload(set, 0));
}

TEST_P(CellUpload, AnEmptySetReplacesAFullOne) {
    CellBuffers buffers(gl_);
    buffers.upload(random_set(10), 1 << 20);
    const std::uint64_t before = buffers.version();
    const auto empty = cell_set({});
    EXPECT_TRUE(buffers.upload(empty, 1 << 20));
    EXPECT_EQ(buffers.shown(), empty);
    EXPECT_GT(buffers.version(), before);
}

TEST_P(CellUpload, NothingNewChangesNothing) {
    CellBuffers buffers(gl_);
    EXPECT_FALSE(buffers.upload(nullptr, 1 << 20));
    EXPECT_EQ(buffers.shown(), nullptr);
}

INSTANTIATE_TEST_SUITE_P(, CellUpload, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
