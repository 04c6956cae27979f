// Slot plans, compared with a model: any sequence of sets, in portions of any size.
#include "render/cells/slot_assignment.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace isochron::render {
namespace {

using index::CellId;

const index::Grid kGrid{.vertices = {9, 7, 8}};
constexpr CellId kCells = 8 * 6 * 7;

/// What a GPU holds that obeys the messages.
struct Model {
    struct Cell {
        std::uint32_t surface = 0;
        CellId id = 0;
        auto operator<=>(const Cell&) const = default;
    };
    std::vector<Cell> slots;

    void obey(const SlotAssignment& assignment, const std::vector<std::uint32_t>& words,
              const index::Extraction& set) {
        slots.resize(set.cells());
        if (assignment.whole()) {
            std::size_t slot = 0;
            for (std::uint32_t s = 0; s < set.surfaces.size(); ++s)
                for (std::size_t i = 0; i < set.surfaces[s].ids.size(); ++i, ++slot)
                    slots[slot] = {s, words[slot]};
            return;
        }
        for (std::size_t i = 0; i < words.size(); i += 2) {
            const std::uint32_t slot = words[i] % SlotAssignment::kMostSlots;
            ASSERT_LT(slot, slots.size());
            slots[slot] = {words[i] >> SlotAssignment::kSurfaceShift, words[i + 1]};
        }
    }
    std::vector<Cell> sorted() const {
        auto all = slots;
        std::ranges::sort(all);
        return all;
    }
};

std::vector<Model::Cell> cells_of(const index::Extraction& set) {
    std::vector<Model::Cell> all;
    for (std::uint32_t s = 0; s < set.surfaces.size(); ++s)
        for (const CellId id : set.surfaces[s].ids)
            all.push_back({s, id});
    return all;
}

index::Extraction set_of(const std::vector<std::vector<CellId>>& surfaces) {
    index::Extraction set;
    for (const auto& ids : surfaces)
        set.surfaces.emplace_back().ids = ids;
    return set;
}

/// A few cells more and a few less, or something else altogether.
std::vector<CellId> changed(std::mt19937& random, const std::vector<CellId>& ids) {
    std::set<CellId> cells(ids.begin(), ids.end());
    const auto kind = random() % 6;
    if (kind == 0 || kind == 1)
        cells.clear();
    const auto most = kind == 1 ? kCells : 12;
    for (auto n = kind == 0 ? 0 : random() % most; n > 0; --n)
        cells.insert(static_cast<CellId>(random() % kCells));
    if (kind > 2)
        for (auto n = random() % 12; n > 0 && !cells.empty(); --n)
            cells.erase(std::next(cells.begin(), std::ptrdiff_t(random() % cells.size())));
    return {cells.begin(), cells.end()};
}

struct Made {
    Slots slots;
    std::vector<std::uint32_t> words;
};

/// Runs a assignment in portions of at most so many cells and words.
Made run(SlotAssignment& assignment, std::mt19937& random, std::size_t most) {
    const auto portion = [&] { return 1 + random() % most; };
    Made made;
    while (!assignment.merge(portion())) {
    }
    for (int tries = 0; !assignment.done(); ++tries) {
        EXPECT_LT(tries, 100'000) << "the assignment does not get on";
        std::vector<std::uint32_t> out(1 + portion());
        std::size_t cells = portion();
        out.resize(assignment.message(out, cells));
        made.words.insert(made.words.end(), out.begin(), out.end());
    }
    EXPECT_EQ(made.words.size(), assignment.words());
    made.slots = assignment.take();
    return made;
}

TEST(SlotAssignment, WhateverFollowsTheSlotsHoldTheNewSetExactlyAndItsPlaces) {
    std::mt19937 random(test_seed());
    index::Extraction shown;
    Slots slots;
    Model model;
    std::size_t whole = 0, deltas = 0;
    for (int round = 0; round < 600; ++round) {
        std::vector<std::vector<CellId>> next(1 + random() % 3);
        for (std::size_t s = 0; s < next.size(); ++s)
            next[s] = changed(random, s < shown.surfaces.size() ? shown.surfaces[s].ids
                                                                : std::vector<CellId>{});
        index::Extraction set = set_of(next);
        SlotAssignment assignment(kGrid, round == 0 ? nullptr : &shown, slots, set);
        Made made = run(assignment, random, round % 2 ? 5 : 1000);
        model.obey(assignment, made.words, set);
        ASSERT_EQ(model.sorted(), cells_of(set)) << "round " << round;
        ASSERT_EQ(made.slots.places.size(), set.cells());
        for (std::size_t slot = 0; slot < model.slots.size(); ++slot) {
            const auto at = kGrid.cell_of(model.slots[slot].id);
            ASSERT_EQ(made.slots.places[slot],
                      (CellPlace{std::uint16_t(at[0]), std::uint16_t(at[1]), std::uint16_t(at[2]),
                                 std::uint16_t(model.slots[slot].surface)}));
        }
        (assignment.whole() ? whole : deltas) += set.cells() > 0;
        shown = std::move(set);
        slots = std::move(made.slots);
    }
    EXPECT_GT(whole, 50u);
    EXPECT_GT(deltas, 50u);
}

TEST(SlotAssignment, SendsNoMoreThanTheChangeAndNeverMoreThanTheSet) {
    std::mt19937 random(test_seed());
    for (int round = 0; round < 200; ++round) {
        const auto before = changed(random, {}), after = changed(random, before);
        const index::Extraction from = set_of({before}), to = set_of({after});
        const Slots none;
        SlotAssignment first(kGrid, nullptr, none, from);
        const Slots slots = run(first, random, 1000).slots;
        SlotAssignment assignment(kGrid, &from, slots, to);
        run(assignment, random, 1000);
        std::vector<CellId> come, go;
        std::ranges::set_difference(after, before, std::back_inserter(come));
        std::ranges::set_difference(before, after, std::back_inserter(go));
        // Each new cell once; where more go than come, each moved cell at most fills their holes.
        EXPECT_LE(assignment.words(), after.size());
        EXPECT_LE(assignment.words(), 2 * std::max(come.size(), go.size()));
        EXPECT_GE(assignment.ids(), come.size());
    }
}

/// The places in `all` of what `others` lacks.
std::vector<std::uint32_t> places_without(const std::vector<CellId>& all,
                                          const std::vector<CellId>& others) {
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < all.size(); ++i)
        if (!std::ranges::binary_search(others, all[i]))
            places.push_back(i);
    return places;
}

TEST(SlotAssignment, AChangeThatIsKnownGivesTheSameSlotsAndMessagesAsComparing) {
    std::mt19937 random(test_seed());
    for (int round = 0; round < 300; ++round) {
        std::vector<std::vector<CellId>> before(1 + random() % 3), after;
        for (std::vector<CellId>& ids : before) {
            ids = changed(random, {});
            after.push_back(changed(random, ids));
        }
        index::Extraction from = set_of(before), to = set_of(after);
        const Slots none;
        SlotAssignment first(kGrid, nullptr, none, from);
        const Slots slots = run(first, random, 1000).slots;
        SlotAssignment compared(kGrid, &from, slots, to);
        const Made expected = run(compared, random, 1000);
        from.number = 7;
        to.change.from = 7;
        for (std::size_t i = 0; i < before.size(); ++i)
            to.change.surfaces.push_back(
                {places_without(before[i], after[i]), places_without(after[i], before[i])});
        SlotAssignment known(kGrid, &from, slots, to);
        const Made found = run(known, random, round % 2 ? 3 : 1000);
        ASSERT_EQ(found.words, expected.words) << "round " << round;
        ASSERT_EQ(found.slots.slot_of_rank, expected.slots.slot_of_rank);
        ASSERT_EQ(found.slots.places, expected.slots.places);
        to.change = {8, std::vector<index::SurfaceChange>(before.size())};
        SlotAssignment of_another(kGrid, &from, slots, to); // the change since some other set
        ASSERT_EQ(run(of_another, random, 1000).words, expected.words);
    }
}

TEST(SlotAssignment, TheSameCellsAgainSendNothing) {
    std::mt19937 random(test_seed());
    const index::Extraction set = set_of({{1, 5, 9, 200}, {5, 6}});
    const Slots none;
    SlotAssignment first(kGrid, nullptr, none, set);
    const Slots slots = run(first, random, 3).slots;
    SlotAssignment again(kGrid, &set, slots, set);
    run(again, random, 3);
    EXPECT_EQ(again.words(), 0u);
}

} // namespace
} // namespace isochron::render
