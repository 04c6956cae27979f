// Cells that are shown before their part of the volume, which follows later.
#include "tests/render/cells/cell_upload.h"

#include <cmath>

namespace isochron::render {
namespace {

class LateVolume : public CellUploadTest {
  protected:
    /// What exact surfaces are drawn from, from GPU memory, by rank.
    std::vector<float> corner_values(CellBuffers& buffers) {
        buffers.compute_corners();
        gl_.BindTextureUnit(0, buffers.corner_values_texture());
        gl_.ActiveTexture(GL_TEXTURE0);
        GLint buffer = 0;
        gl_.GetIntegerv(GL_TEXTURE_BUFFER_DATA_STORE_BINDING, &buffer);
        std::vector<float> values(8 * buffers.size()), by_rank;
        if (!values.empty())
            gl_.GetNamedBufferSubData(GLuint(buffer), 0, GLsizeiptr(values.size() * sizeof(float)),
                                      values.data());
        for (std::size_t rank = 0; rank < buffers.size(); ++rank) {
            const auto from = values.begin() + 8 * buffers.slots().slot_of(rank);
            by_rank.insert(by_rank.end(), from, from + 8);
        }
        return by_rank;
    }
    /// The active cells of an isovalue that few of the values reach.
    index::ExtractionPtr active_set() {
        return extractions_.active(std::uint32_t(random_() % 2), {195.5 + double(random_() % 4)});
    }
    void expect_corners_as_if_new(CellBuffers& buffers, const index::ExtractionPtr& set) {
        CellBuffers fresh(gl_, field_.view().grid);
        fresh.upload(set, kEnough);
        const std::vector<float> values = corner_values(buffers);
        EXPECT_TRUE(std::ranges::all_of(values, [](float value) { return std::isfinite(value); }));
        EXPECT_EQ(values, corner_values(fresh));
    }
};

TEST_P(LateVolume, WithoutTheVolumeItFollowsWhenItIsAskedFor) {
    CellBuffers buffers(gl_, field_.view().grid);
    const auto first = extractions_.shaded(active_set());
    const auto second = extractions_.shaded(active_set());
    for (const auto& set : {first, second}) {
        ASSERT_TRUE(buffers.upload(set, kEnough, SendVolume::never));
        expect_whole(buffers);
        EXPECT_FALSE(buffers.has_volume());
    }
    EXPECT_EQ(buffers.count().block_bytes, 0u);
    const std::uint64_t version = buffers.version();
    int frames = 0;
    while (!buffers.has_volume()) {
        ASSERT_LT(++frames, 1000);
        const std::uint64_t before = buffers.count().block_bytes;
        EXPECT_FALSE(buffers.upload(second, 4000)); // only its cells
        EXPECT_LE(buffers.count().block_bytes - before, 4000u);
    }
    EXPECT_GT(frames, 2);
    EXPECT_EQ(buffers.version(), version);
    expect_corners_as_if_new(buffers, second);
    // What the next set has in common with it is there.
    const auto third = std::make_shared<index::Extraction>(*second);
    const std::uint64_t before = buffers.count().block_bytes;
    ASSERT_TRUE(buffers.upload(third, kEnough));
    EXPECT_EQ(buffers.count().block_bytes, before);
    EXPECT_TRUE(buffers.has_volume());
    expect_corners_as_if_new(buffers, third);
}

TEST_P(LateVolume, CellsWithoutNormalsNeedTheVolumeAtOnce) {
    CellBuffers buffers(gl_, field_.view().grid);
    ASSERT_TRUE(buffers.upload(active_set(), kEnough, SendVolume::never));
    EXPECT_TRUE(buffers.has_volume());
    expect_whole(buffers);
}

TEST_P(LateVolume, AnyRunOfSetsWithAndWithoutTheVolumeShowsEachWhole) {
    CellBuffers buffers(gl_, field_.view().grid, 512);
    index::ExtractionPtr set;
    int asked_for = 0, followed = 0;
    for (int frame = 0; frame < 3000; ++frame) {
        if (!set || random_() % 12 == 0) {
            set = active_set();
            if (random_() % 4)
                set = extractions_.shaded(set);
        }
        const auto volume = frame / 50 % 2 ? SendVolume::with_cells : SendVolume::never;
        const bool had = buffers.has_volume();
        const auto before = buffers.shown();
        const bool complete = random_() % 8 ? buffers.upload(set, 16 + random_() % 6000, volume)
                                            : buffers.stage(set, 16 + random_() % 6000);
        let_a_frame_pass();
        if (!buffers.shown())
            continue;
        EXPECT_TRUE(!had || buffers.shown() != before || buffers.has_volume());
        asked_for += !had && volume == SendVolume::with_cells;
        followed += !had && buffers.has_volume();
        if (complete || frame % 50 == 0)
            expect_whole(buffers);
        if (buffers.has_volume() && !buffers.pending()) { // nothing is left of what gave way
            EXPECT_EQ(buffers.blocks()->size(), buffers.shown()->blocks.ids.size());
        }
        if (buffers.has_volume() && frame % 20 == 0)
            expect_corners_as_if_new(buffers, buffers.shown());
    }
    EXPECT_GT(followed, 10);
    EXPECT_GT(asked_for, followed);
}

INSTANTIATE_TEST_SUITE_P(, LateVolume, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
