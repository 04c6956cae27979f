// Damaged bytes of cells and deltas are refused, or searched without reading outside them.
#include "tests/index/cells/cell_series.h"

#include "index/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace isochron::index {
namespace {

constexpr std::uint32_t kSteps = 5;

/// Tables of every form: sparse, narrow and wide.
CellSeries sound_series(const TestField& field) {
    return {field.view(), LevelMap::of_type(ValueType::u8)};
}

TestField test_field(std::mt19937& random) {
    return TestField({40, 36, 33}, kSteps, ValueType::u8, scaled(turbulence(random, 3), 120, 60));
}

bool may_be_searched(const CellUnit& unit, std::uint32_t cells) {
    if (!unit.check_head(kSteps, cells))
        return false;
    for (std::uint32_t node = 0; node < TimeNode::count(kSteps); ++node)
        if (!unit.check_table(node))
            return false;
    return true;
}
bool may_be_searched(const DeltaUnit& unit, std::uint32_t cells) {
    if (!unit.check_head(kSteps, cells))
        return false;
    for (std::uint32_t step = 0; step < kSteps; ++step)
        if (!unit.check_transition(step))
            return false;
    return true;
}

/// Searches a copy in a block of its own, whose borders the address sanitizer guards.
/// @return whether it was taken for sound
template <class Unit>
bool survives(const std::vector<std::byte>& bytes, std::uint32_t cells, std::mt19937& random) {
    const std::vector<std::byte> copy(bytes); // NOLINT: a block of its own
    const Unit unit(copy, 0);
    if (!may_be_searched(unit, cells)) {
        EXPECT_FALSE(unit.check(kSteps, cells));
        return false;
    }
    const bool sound = unit.check(kSteps, cells);
    (void)unit.entries();
    std::vector<CellId> ids;
    for (int search = 0; search < 10; ++search) {
        const std::uint32_t step = below(random, kSteps);
        const LevelMap::Cut cut{static_cast<std::uint8_t>(1 + below(random, 255)), true};
        const LevelMap::Cut other{static_cast<std::uint8_t>(1 + below(random, 255)), true};
        std::vector<IdRun> a, b;
        {
            RunBuffer to_a(a), to_b(b);
            if constexpr (std::is_same_v<Unit, CellUnit>) {
                const TimePath path(TimeNode::root(kSteps), step);
                unit.search(path, cut, to_a, to_b);
                unit.level_difference(path, cut, other, to_a, to_b);
            } else {
                unit.change(step, cut, to_a, to_b);
            }
        }
        for (const std::vector<IdRun>* runs : {&a, &b}) {
            std::vector<CellId> found;
            assign_ids(*runs, found);
            ids.insert(ids.end(), found.begin(), found.end());
        }
    }
    if (sound && !ids.empty()) {
        EXPECT_LT(*std::ranges::max_element(ids), cells);
    }
    return true;
}

/// Makes the checksums right again, as someone who means harm would.
void seal(std::vector<std::byte>& bytes) {
    CellUnitHead head;
    std::memcpy(&head, bytes.data(), sizeof head);
    const std::size_t refs = sizeof head + head.tables * sizeof(TableRef);
    if (refs > bytes.size())
        return;
    for (std::size_t at = sizeof head; at < refs; at += sizeof(TableRef)) {
        TableRef ref;
        std::memcpy(&ref, bytes.data() + at, sizeof ref);
        const std::size_t begin = std::size_t{ref.offset} * CellTableHead::kAlignment,
                          size = std::size_t{ref.size} * CellTableHead::kAlignment;
        if (begin + size > bytes.size())
            continue;
        const std::size_t directory =
            size < sizeof(CellTableHead) ? size : CellTable(bytes.data() + begin).head().ids;
        if (directory > size)
            continue;
        ref.checksum = cell_checksum(std::span(bytes).subspan(begin, directory));
        std::memcpy(bytes.data() + at, &ref, sizeof ref);
    }
    head.checksum = 0;
    std::memcpy(bytes.data(), &head, sizeof head);
    head.checksum = cell_checksum(std::span(bytes).first(refs));
    std::memcpy(bytes.data(), &head, sizeof head);
}

bool same_but_for_ids(std::vector<std::byte> a, std::vector<std::byte> b) {
    CellUnitHead head;
    std::memcpy(&head, b.data(), sizeof head);
    for (std::uint32_t i = 0; i < head.tables; ++i) {
        TableRef ref;
        std::memcpy(&ref, b.data() + sizeof head + i * sizeof ref, sizeof ref);
        if (ref.offset == 0)
            continue;
        const std::size_t begin = std::size_t{ref.offset} * CellTableHead::kAlignment;
        const std::size_t ids = CellTable(b.data() + begin).head().ids;
        const std::size_t end = std::size_t{ref.size} * CellTableHead::kAlignment;
        std::fill(a.begin() + std::ptrdiff_t(begin + ids), a.begin() + std::ptrdiff_t(begin + end),
                  std::byte{0});
        std::fill(b.begin() + std::ptrdiff_t(begin + ids), b.begin() + std::ptrdiff_t(begin + end),
                  std::byte{0});
    }
    return a == b;
}

template <class Unit>
void refuses_every_truncation(const std::vector<std::byte>& bytes, std::uint32_t cells) {
    std::mt19937 random(test_seed());
    ASSERT_TRUE(survives<Unit>(bytes, cells, random));
    for (std::size_t size = 0; size < bytes.size(); size += size < 600 ? 1 : 997)
        EXPECT_FALSE(survives<Unit>({bytes.begin(), bytes.begin() + size}, cells, random)) << size;
    std::vector<std::byte> longer = bytes;
    longer.resize(bytes.size() + 8);
    EXPECT_FALSE(survives<Unit>(longer, cells, random));
    EXPECT_FALSE(survives<Unit>(bytes, cells + 1, random));
}

template <class Unit>
void never_leaves(const std::vector<std::byte>& bytes, std::uint32_t cells) {
    std::mt19937 random(test_seed());
    // Where tables begin: heads and directories are what a search goes by.
    std::vector<std::size_t> tables{0};
    CellUnitHead head;
    std::memcpy(&head, bytes.data(), sizeof head);
    for (std::uint32_t i = 0; i < head.tables; ++i) {
        TableRef ref;
        std::memcpy(&ref, bytes.data() + sizeof head + i * sizeof ref, sizeof ref);
        tables.push_back(std::size_t{ref.offset} * CellTableHead::kAlignment);
    }
    const std::size_t slack = IdRun::kSlack * sizeof(std::uint16_t) + 8; // bytes without meaning
    int refused = 0;
    const int kTrials = tries(4000);
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<std::byte> damaged = bytes;
        for (std::uint32_t flips = 1 + random() % 4; flips-- > 0;) {
            const std::size_t begin = tables[random() % tables.size()];
            const std::size_t range = trial % 3 == 0 ? 28 : trial % 3 == 1 ? 3000 : bytes.size();
            const std::size_t at = begin + random() % std::min(range, bytes.size() - slack - begin);
            damaged[at] ^= static_cast<std::byte>(1 << random() % 8);
        }
        // What a search goes by is covered by checksums, the ids are not.
        ASSERT_EQ(survives<Unit>(damaged, cells, random), same_but_for_ids(damaged, bytes));
        seal(damaged);
        refused += !survives<Unit>(damaged, cells, random);
    }
    EXPECT_GT(refused, kTrials / 4);
    EXPECT_LT(refused, kTrials);
}

TEST(CellDamage, IsRefusedWhereverTheBytesEnd) {
    std::mt19937 random(test_seed());
    const TestField field = test_field(random);
    const CellSeries series = sound_series(field);
    const std::uint32_t cells = Stretches(field.view().grid).cells(0);
    refuses_every_truncation<CellUnit>(series.cells.front(), cells);
    refuses_every_truncation<DeltaUnit>(series.deltas.front(), cells);
}

TEST(CellDamage, NeverLeadsOutOfTheBytes) {
    std::mt19937 random(test_seed());
    const TestField field = test_field(random);
    const CellSeries series = sound_series(field);
    const std::uint32_t cells = Stretches(field.view().grid).cells(0);
    never_leaves<CellUnit>(series.cells.front(), cells);
    never_leaves<DeltaUnit>(series.deltas.front(), cells);
}

TEST(CellDamage, IsReportedAtTheFirstUse) {
    std::mt19937 random(test_seed());
    const TestField field = test_field(random);
    CellSeries series = sound_series(field);
    const CellTier sound = series.tier();
    std::vector<IdRun> runs, none;
    EXPECT_NO_THROW(sound.search(0, {50, true}, runs, none));
    EXPECT_NO_THROW(sound.verify());
    series.cells.front()[0] ^= std::byte{1};
    const CellTier damaged = series.tier();
    try {
        damaged.search(0, {50, true}, runs, none);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "cells of chunk 0 in epoch 0: damaged");
    }
    EXPECT_THROW(damaged.verify(), Error);
    series.cells.front()[0] ^= std::byte{1};
    EXPECT_NO_THROW(series.tier().verify());
    // What a search does not need is not looked at.
    TableRef last;
    const std::size_t ref = sizeof(CellUnitHead) + (TimeNode::count(kSteps) - 1) * sizeof last;
    std::memcpy(&last, series.cells.front().data() + ref, sizeof last);
    series.cells.front()[std::size_t{last.offset} * CellTableHead::kAlignment + 100] ^=
        std::byte{1};
    const CellTier partly = series.tier();
    EXPECT_NO_THROW(partly.search(0, {50, true}, runs, none));
    EXPECT_THROW(partly.search(kSteps - 1, {50, true}, runs, none), Error);
    EXPECT_THROW(partly.verify(), Error);
    series.cells.pop_back();
    EXPECT_THROW(series.tier(), Error);
}

} // namespace
} // namespace isochron::index
