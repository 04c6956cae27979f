// The pool of volume blocks: its contents agree with the volume, and it is no larger than two sets
// need.
#include "render/cells/block_pool.h"
#include "render/cells/cell_compute.h"
#include "tests/render/cells/extractions.h"
#include "tests/support/drawing/gl_test.h"

#include <algorithm>

namespace isochron::render {
namespace {

using index::CellId;
using index::TestField;
using index::ValueType;

class Blocks : public GlTest {
  protected:
    std::vector<std::byte> bytes_of(GLuint buffer, std::size_t offset, std::size_t count) {
        std::vector<std::byte> bytes(count);
        gl_.GetNamedBufferSubData(buffer, GLintptr(offset), GLsizeiptr(count), bytes.data());
        return bytes;
    }
    /// The GPU's pages lead to exactly these blocks.
    void expect_held(const BlockPool& pool, const index::VolumeBlocks& blocks) {
        const std::size_t size = blocks.block_bytes();
        for (std::size_t i = 0; i < blocks.ids.size(); ++i) {
            std::uint32_t slot = 0;
            gl_.GetNamedBufferSubData(pool.pages().buffer(), GLintptr{4} * blocks.ids[i], 4, &slot);
            const auto held = bytes_of(pool.values().buffer(), slot * size, size);
            ASSERT_TRUE(std::ranges::equal(held, blocks.block(i))) << "block " << blocks.ids[i];
        }
    }
    std::vector<CellId> near(const index::Grid& grid, std::size_t count) {
        std::vector<CellId> ids;
        const std::size_t first = random_() % grid.cell_count();
        for (std::size_t i = 0; i < count; ++i)
            ids.push_back(CellId((first + random_() % 700) % grid.cell_count()));
        std::ranges::sort(ids);
        const auto repeated = std::ranges::unique(ids);
        ids.erase(repeated.begin(), repeated.end());
        return ids;
    }
};

TEST_P(Blocks, ThePagesLeadToTheVolumeForEveryType) {
    for (const ValueType type : index::kAllTypes) {
        const TestField field({30, 21, 25}, 3, type,
                              index::scaled(index::white_noise(random_), 50, 0));
        const auto values = field.view();
        Extractions extractions(values);
        const index::ValueType held = extractions.block_values().held();
        BlockPool pool(gl_, values.grid, held);
        const AxisTable axes(gl_, values.grid);
        const CellCompute compute(gl_, values.grid, axes, held);
        StagingRing ring(gl_, 8192);
        index::ExtractionPtr shown;
        for (int round = 0; round < 25; ++round) {
            const auto set =
                extractions.of_cells(std::uint32_t(random_() % 3), {near(values.grid, 40)});
            pool.begin(set->blocks);
            for (int tries = 0; !pool.complete(); ++tries) {
                ASSERT_LT(tries, 100'000);
                const std::size_t budget = StagingRing::kUnit + random_() % 5000;
                ASSERT_LE(pool.send(ring, budget), budget);
                ring.end_frame();
                if (shown)
                    expect_held(pool, shown->blocks); // untouched until the next one is shown
            }
            const std::size_t both =
                set->blocks.ids.size() + (shown ? shown->blocks.ids.size() : 0);
            EXPECT_LE(pool.size(), both);
            compute.enter_pages(pool);
            pool.show();
            shown = set;
            expect_held(pool, shown->blocks);
            EXPECT_EQ(pool.size(), set->blocks.ids.size());
        }
        EXPECT_LE(pool.capacity(), 300u);
    }
}

TEST_P(Blocks, WhatThePoolHasIsNotSentAgain) {
    const TestField field(
        {40, 24, 24}, 2, ValueType::u8, [](double x, double y, double z, double t) {
            return x < 16 ? x + y + z : x + y + z + t; // changes in a part of the volume only
        });
    Extractions extractions(field.view());
    BlockPool pool(gl_, field.view().grid, ValueType::u8);
    const AxisTable axes(gl_, field.view().grid);
    const CellCompute compute(gl_, field.view().grid, axes, ValueType::u8);
    StagingRing ring(gl_, 1 << 20);
    std::vector<CellId> all(field.view().grid.cell_count());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = CellId(i);
    const std::size_t block = index::kBlockVertices + 8;
    const auto sent_for = [&](const index::ExtractionPtr& set) {
        pool.begin(set->blocks);
        const std::size_t sent = pool.send(ring, 1 << 20);
        EXPECT_TRUE(pool.complete());
        compute.enter_pages(pool);
        pool.show();
        ring.end_frame();
        return sent;
    };
    EXPECT_EQ(sent_for(extractions.of_cells(0, {all})), 5 * 3 * 3 * block);
    EXPECT_EQ(sent_for(extractions.of_cells(0, {all})), 0u);
    const auto second = extractions.of_cells(1, {all});
    EXPECT_EQ(sent_for(second), 3 * 3 * 3 * block);
    expect_held(pool, second->blocks);
}

INSTANTIATE_TEST_SUITE_P(, Blocks, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
