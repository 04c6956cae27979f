// Uploads of cell sets: only differences, within the budget, never half a set, and every stream of
// sets makes progress.
#include "index/surface/cell_colors.h"
#include "tests/render/cells/cell_upload.h"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

namespace isochron::render {
namespace {

using index::CellId;
using index::TestField;
using index::ValueType;

std::size_t copied_bytes = 0;
PFNGLCOPYNAMEDBUFFERSUBDATAPROC real_copy = nullptr;
void APIENTRY counting_copy(GLuint from, GLuint to, GLintptr read, GLintptr write,
                            GLsizeiptr size) {
    copied_bytes += static_cast<std::size_t>(size);
    real_copy(from, to, read, write, size);
}

class CellUpload : public CellUploadTest {
  protected:
    CellUpload() {
        real_copy = gl_.CopyNamedBufferSubData;
        gl_.CopyNamedBufferSubData = counting_copy;
    }

    /// Each drawn cell with its color coordinate against those of the set.
    void expect_colors(const CellBuffers& buffers) {
        const index::Extraction& set = *buffers.shown();
        const auto points = drawn_points(buffers);
        ASSERT_EQ(points.size(), set.cells());
        std::size_t rank = 0;
        for (unsigned s = 0; s < set.surfaces.size(); ++s)
            for (std::size_t i = 0; i < set.surfaces[s].ids.size(); ++i, ++rank) {
                const unsigned style = points[buffers.slots().slot_of(rank)].style;
                ASSERT_EQ(style & 7u, s);
                ASSERT_EQ(style >> 3, set.colors.empty() ? 0u : set.colors[rank]);
            }
    }
    /// The set with colors of its own, among them the first, the last, and none.
    index::ExtractionPtr colored(const index::ExtractionPtr& set) {
        auto with = std::make_shared<index::Extraction>(*set);
        for (std::size_t i = 0; i < with->cells(); ++i)
            with->colors.push_back(std::array<std::uint16_t, 4>{
                0, index::kColorSteps, index::kNoColor,
                std::uint16_t(random_() % index::kColorSteps)}[random_() % 4]);
        return with;
    }
};

TEST_P(CellUpload, StaysWithinTheBudgetAndShowsWholeSetsOnly) {
    CellBuffers buffers(gl_, field_.view().grid);
    const auto first = extractions_.of_cells(0, {random_ids(500)});
    const auto second = extractions_.of_cells(1, {random_ids(300)}); // other blocks, too
    ASSERT_TRUE(buffers.upload(first, kEnough));
    EXPECT_EQ(buffers.shown(), first);
    expect_whole(buffers);
    int frames = 0;
    for (bool changed = false; !changed; ++frames) {
        ASSERT_LT(frames, 1000);
        copied_bytes = 0;
        changed = buffers.upload(second, 1003);
        EXPECT_LE(copied_bytes, 1003u);
        EXPECT_EQ(buffers.shown(), changed ? second : first);
        EXPECT_EQ(buffers.pending(), !changed);
        expect_whole(buffers);
    }
    EXPECT_GT(frames, 4);
    copied_bytes = 0;
    EXPECT_FALSE(buffers.upload(second, 1 << 20));
    EXPECT_EQ(copied_bytes, 0u);
}

TEST_P(CellUpload, FinishesWhatItBeganHoweverFastNewSetsArrive) {
    CellBuffers buffers(gl_, field_.view().grid);
    std::vector<index::ExtractionPtr> sets;
    int changes = 0;
    for (int frame = 0; frame < 300; ++frame) {
        sets.push_back(random_set(300));
        changes += buffers.upload(sets.back(), 4000);
        if (buffers.shown())
            expect_whole(buffers);
    }
    EXPECT_GT(changes, 15);
    EXPECT_NE(std::find(sets.end() - 20, sets.end(), buffers.shown()), sets.end());
}

TEST_P(CellUpload, ABudgetOfNothingStillMovesOn) {
    CellBuffers buffers(gl_, field_.view().grid, 2 * StagingRing::kUnit);
    const auto set = extractions_.of_cells(0, {{5, 6, 9}});
    EXPECT_FALSE(buffers.upload(set, 0));
    int frames = 1;
    while (!buffers.upload(set, 0)) {
        ASSERT_LT(++frames, 1000);
        let_a_frame_pass();
    }
    expect_whole(buffers);
}

TEST_P(CellUpload, AnyRunOfSetsShowsEachWholeWithTinyBudgetsAndSkips) {
    CellBuffers buffers(gl_, field_.view().grid, 512);
    const auto next_ids = [&](std::vector<CellId> ids) {
        std::set<CellId> cells(ids.begin(), ids.end());
        if (random_() % 8 == 0)
            cells.clear();
        for (auto n = random_() % 40; n > 0 && !cells.empty(); --n)
            cells.erase(std::next(cells.begin(), std::ptrdiff_t(random_() % cells.size())));
        for (const CellId id : random_ids(random_() % 60))
            cells.insert(id);
        return std::vector<CellId>(cells.begin(), cells.end());
    };
    index::ExtractionPtr set, last_shown, begun;
    std::uint64_t version = 0, whole = 0, sets = 0;
    for (int frame = 0; frame < 3000; ++frame) {
        if (!set || random_() % 10 == 0) {
            std::vector<std::vector<CellId>> surfaces(1 + random_() % 3);
            for (std::size_t s = 0; s < surfaces.size(); ++s)
                surfaces[s] = next_ids(set && s < set->surfaces.size() ? set->surfaces[s].ids
                                                                       : std::vector<CellId>{});
            set = extractions_.of_cells(std::uint32_t(random_() % 2), surfaces);
        }
        const bool changed = buffers.upload(set, random_() % 3 ? 16 + random_() % 6000 : 0);
        let_a_frame_pass();
        EXPECT_EQ(changed, buffers.version() > version);
        version = buffers.version();
        if (changed || frame % 50 == 0) {
            if (buffers.shown())
                expect_whole(buffers);
            EXPECT_EQ(buffers.shown() != last_shown, changed);
        }
        if (changed) { // what was on its way, and in the same frame perhaps the newest, too
            last_shown = buffers.shown();
            sets += (begun != nullptr) + (last_shown != begun);
            whole += (begun ? begun->cells() : 0) + (last_shown != begun ? set->cells() : 0);
            EXPECT_TRUE(last_shown == begun || last_shown == set);
            begun = nullptr;
        }
        if (buffers.pending() && !begun)
            begun = set;
    }
    EXPECT_EQ(buffers.count().sets, sets);
    EXPECT_EQ(buffers.count().whole_ids, whole);
    EXPECT_LT(buffers.count().ids, whole);
    EXPECT_GT(sets, 20u);
}

TEST_P(CellUpload, CountsTheIdsAndTheBytesThatAreSent) {
    CellBuffers buffers(gl_, field_.view().grid);
    std::vector<CellId> ids = random_ids(400);
    const auto first = extractions_.of_cells(0, {ids});
    copied_bytes = 0;
    buffers.upload(first, kEnough);
    const std::size_t block = index::kBlockVertices + 2 * sizeof(std::uint32_t); // with its page
    const std::uint64_t blocks = first->blocks.ids.size();
    EXPECT_EQ(buffers.count(), (UploadCount{1, 400, 400, 1600, blocks * block}));
    // Ten go and ten come: ten slots change. The step is the same, and the blocks are there.
    const std::set<CellId> there(ids.begin(), ids.end());
    for (int i = 0; i < 10; ++i)
        ids.erase(ids.begin() + 7 * i);
    for (CellId id = 0, added = 0; added < 10; ++id)
        if (!there.contains(id)) {
            ids.push_back(id);
            ++added;
        }
    std::ranges::sort(ids);
    const auto second = extractions_.of_cells(0, {ids});
    ASSERT_EQ(second->blocks.ids.size(), blocks);
    buffers.upload(second, kEnough);
    EXPECT_EQ(buffers.count(), (UploadCount{2, 410, 800, 1680, blocks * block}));
}

TEST_P(CellUpload, ColorsOnOffAndChangedAreThoseOfTheSetWithAnyBudget) {
    CellBuffers buffers(gl_, field_.view().grid, 512);
    const auto set = extractions_.of_cells(0, {random_ids(301), {}, random_ids(90)});
    const auto other = extractions_.of_cells(1, {random_ids(295), random_ids(7)});
    std::vector<index::ExtractionPtr> sets{set, colored(set), colored(set), other, colored(other)};
    for (int i = 0; i < 20; ++i) { // a few cells more or less each time, then anything
        const auto& from = sets[random_() % sets.size()];
        auto ids = from->surfaces[0].ids;
        ids.erase(ids.begin() + std::ptrdiff_t(random_() % ids.size()));
        const auto next = extractions_.of_cells(0, {ids, random_ids(random_() % 5)});
        sets.push_back(random_() % 3 ? colored(next) : next);
    }
    for (const auto& next : sets) {
        const auto before = buffers.shown();
        int frames = 0;
        bool changed = false;
        while (!changed) {
            ASSERT_LT(++frames, 20'000);
            const UploadCount earlier = buffers.count();
            const std::size_t budget = random_() % 3 ? 16 + random_() % 3000 : 0;
            changed = buffers.upload(next, budget);
            let_a_frame_pass();
            const UploadCount sent = buffers.count().since(earlier);
            EXPECT_LE(sent.id_bytes + sent.block_bytes + sent.color_bytes,
                      std::max(budget, StagingRing::kUnit));
            if (!changed && before && frames % 16 == 0)
                expect_colors(buffers); // the old ones, all of them
        }
        ASSERT_EQ(buffers.shown(), next);
        expect_whole(buffers);
        expect_colors(buffers);
    }
}

TEST_P(CellUpload, ColorsAreCountedApartFromIds) {
    CellBuffers buffers(gl_, field_.view().grid);
    const auto set = extractions_.of_cells(0, {random_ids(401)});
    buffers.upload(set, kEnough);
    const UploadCount before = buffers.count();
    copied_bytes = 0;
    buffers.upload(colored(set), kEnough);
    EXPECT_EQ(buffers.count().since(before), (UploadCount{1, 0, 401, 0, 0, 802}));
    EXPECT_EQ(copied_bytes, 802u);
}

TEST_P(CellUpload, AnEmptySetReplacesAFullOneAndAFullOneAnEmptyOne) {
    CellBuffers buffers(gl_, field_.view().grid);
    const auto full = random_set(10), empty = random_set(0);
    for (const auto& set : {full, empty, full, empty}) {
        const std::uint64_t before = buffers.version();
        EXPECT_TRUE(buffers.upload(set, 1 << 20));
        EXPECT_EQ(buffers.shown(), set);
        EXPECT_GT(buffers.version(), before);
        expect_whole(buffers);
    }
}

TEST_P(CellUpload, NothingNewChangesNothing) {
    CellBuffers buffers(gl_, field_.view().grid);
    EXPECT_FALSE(buffers.upload(nullptr, 1 << 20));
    EXPECT_EQ(buffers.shown(), nullptr);
}

TEST_P(CellUpload, BuffersMayMoveWhileASetIsOnItsWay) {
    CellBuffers buffers(gl_, field_.view().grid);
    buffers.upload(random_set(200), kEnough);
    const auto next = random_set(200);
    ASSERT_FALSE(buffers.upload(next, 700));
    CellBuffers moved(std::move(buffers));
    while (!moved.upload(next, 700)) {
    }
    expect_whole(moved);
}

int linked = 0;
PFNGLLINKPROGRAMPROC real_link = nullptr;
void APIENTRY counting_link(GLuint program) {
    ++linked;
    real_link(program);
}

TEST_P(CellUpload, WhatIsPreparedCompilesNothingWhenTheFirstSetComes) {
    real_link = gl_.LinkProgram;
    gl_.LinkProgram = counting_link;
    CellBuffers buffers(gl_, field_.view().grid);
    buffers.prepare(ValueType::u8);
    EXPECT_EQ(buffers.size(), 0u);
    linked = 0;
    ASSERT_TRUE(buffers.upload(random_set(100), kEnough));
    buffers.compute_corners();
    EXPECT_EQ(linked, 0);
    expect_whole(buffers);
}

TEST_P(CellUpload, SetsOfArraysWithValuesOfOtherTypesFollowEachOther) {
    const TestField floats({kSide + 1, kSide + 1, kSide + 1}, 2, ValueType::f32,
                           index::turbulence(random_));
    Extractions of_floats(floats.view());
    const auto by_place = [&](const CellBuffers& buffers) {
        std::vector<std::array<std::uint32_t, 4>> all;
        for (const index::CellPoint& p : drawn_points(buffers))
            all.push_back({p.x, p.y, p.z, p.plane});
        std::ranges::sort(all);
        return all;
    };
    real_link = gl_.LinkProgram;
    gl_.LinkProgram = counting_link;
    CellBuffers buffers(gl_, field_.view().grid);
    buffers.prepare(ValueType::u8);
    buffers.prepare(ValueType::f32);
    linked = 0;
    for (int turn = 0; turn < 3; ++turn) {
        const auto set =
            turn % 2 == 0 ? extractions_.active(0, {100.5}) : of_floats.active(1, {0.1});
        ASSERT_GT(set->cells(), 100u);
        ASSERT_TRUE(buffers.upload(set, kEnough));
        EXPECT_EQ(linked, 0) << "both were made ready";
        EXPECT_TRUE(buffers.has_volume());
        expect_whole(buffers);
        CellBuffers fresh(gl_, field_.view().grid);
        ASSERT_TRUE(fresh.upload(set, kEnough));
        EXPECT_EQ(by_place(buffers), by_place(fresh)) << turn;
        linked = 0;
    }
}

GLenum APIENTRY never_passed(GLsync, GLbitfield, GLuint64) {
    return GL_TIMEOUT_EXPIRED;
}

TEST_P(CellUpload, WhereTheGpuIsBehindTheFrameGoesOnAndTheSetLater) {
    CellBuffers buffers(gl_, field_.view().grid, 4096);
    const auto set = random_set(500);
    const auto real = gl_.ClientWaitSync;
    gl_.ClientWaitSync = never_passed;
    for (int frame = 0; frame < 20; ++frame)
        EXPECT_FALSE(buffers.upload(set, kEnough));
    gl_.ClientWaitSync = real;
    for (int frame = 0; !buffers.shown(); ++frame) {
        ASSERT_LT(frame, 100'000);
        buffers.upload(set, kEnough);
    }
    expect_whole(buffers);
}

PFNGLGETINTEGERVPROC real_integer = nullptr;
void APIENTRY small_textures(GLenum name, GLint* value) {
    real_integer(name, value);
    if (name == GL_MAX_TEXTURE_BUFFER_SIZE)
        *value = 100'000;
}

TEST_P(CellUpload, ASetThatTheDriverCannotHoldIsRefusedWithALineAndTheLastOneKept) {
    real_integer = gl_.GetIntegerv;
    gl_.GetIntegerv = small_textures;
    const TestField field({2, 400, 300}, 1, ValueType::u8, index::white_noise(random_));
    Extractions extractions(field.view());
    std::vector<CellId> all(field.view().grid.cell_count());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = CellId(i);
    CellBuffers buffers(gl_, field.view().grid);
    EXPECT_EQ(buffers.corner_limit(), 25'000u);
    const auto few = std::vector<CellId>(all.begin(), all.begin() + 900);
    const auto fits = extractions.of_cells(0, {few}), too_many = extractions.of_cells(0, {all});
    const auto too_much = extractions.of_cells(0, {{all.begin(), all.begin() + 90'000}});
    ASSERT_TRUE(buffers.upload(fits, kEnough));
    for (int frame = 0; frame < 3; ++frame) {
        EXPECT_FALSE(buffers.upload(too_many, kEnough));
        EXPECT_EQ(buffers.shown(), fits);
        EXPECT_EQ(buffers.refused(), too_many);
        EXPECT_EQ(buffers.refusal(), "119301 cells at step 0: this GL can draw at most 100000, so "
                                     "the last ones stay");
    }
    // There is room for these cells, and not for the volume around them.
    const std::size_t blocks = too_much->blocks.ids.size();
    ASSERT_GT(blocks, 100'000u / 512);
    EXPECT_FALSE(buffers.upload(too_much, kEnough));
    EXPECT_EQ(buffers.refusal(), std::to_string(blocks) +
                                     " blocks of the volume at step 0: this GL holds at most 195, "
                                     "so the last cells stay");
    EXPECT_TRUE(buffers.stage(too_much, kEnough)) << "nothing is left to send";
    EXPECT_FALSE(buffers.upload(fits, kEnough));
    const auto shaded = extractions.shaded(too_much);
    EXPECT_TRUE(buffers.upload(shaded, kEnough)) << "cells that come with their planes need none";
    EXPECT_EQ(buffers.refused(), nullptr);
    EXPECT_FALSE(buffers.has_volume());
    EXPECT_FALSE(buffers.wants_volume());
    EXPECT_FALSE(buffers.upload(shaded, kEnough));
    ASSERT_TRUE(buffers.upload(fits, kEnough));
    EXPECT_TRUE(buffers.has_volume());
}

TEST_P(CellUpload, SetsThatFitOneByOneFollowEachOtherWhereBothDoNot) {
    real_integer = gl_.GetIntegerv;
    gl_.GetIntegerv = small_textures;
    const TestField field({70, 70, 9}, 2, ValueType::u8, index::white_noise(random_));
    Extractions extractions(field.view());
    CellBuffers buffers(gl_, field.view().grid);
    const std::size_t cells = field.view().grid.cell_count();
    std::vector<CellId> all(cells);
    for (std::size_t i = 0; i < cells; ++i)
        all[i] = CellId(i);
    for (const std::uint32_t step : {0u, 1u, 0u}) {
        const auto set = extractions.of_cells(step, {all});
        ASSERT_GT(2 * set->blocks.ids.size(), 195u);
        ASSERT_LE(set->blocks.ids.size(), 195u);
        ASSERT_TRUE(buffers.upload(set, kEnough)) << buffers.refusal();
        EXPECT_TRUE(buffers.has_volume());
        EXPECT_LE(buffers.blocks()->capacity(), 195u);
    }
}

INSTANTIATE_TEST_SUITE_P(, CellUpload, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
