// Points that come with a set, given in portions.
#include "render/cells/ranked_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace isochron::render {
namespace {

index::Extraction random_set(std::mt19937& random, bool colored) {
    index::Extraction set;
    set.surfaces.resize(1 + random() % 4);
    for (index::CellSet& surface : set.surfaces)
        for (auto cells = random() % 4 ? random() % 50 : 0; cells > 0; --cells) {
            const auto any = [&] { return static_cast<std::uint16_t>(random()); };
            surface.ids.push_back(index::CellId(surface.ids.size()));
            surface.points.push_back({any(), any(), any(), 0, std::uint32_t(random())});
        }
    for (std::size_t i = 0; colored && i < set.cells(); ++i)
        set.colors.push_back(std::uint16_t(random() % 8192));
    return set;
}

TEST(RankedPoints, AreAllOfTheSetInPortionsOfAnySize) {
    std::mt19937 random(1);
    for (int turn = 0; turn < 200; ++turn) {
        const index::Extraction set = random_set(random, turn % 2);
        const std::size_t portion = 1 + random() % 70;
        RankedPoints ranked(set);
        std::vector<index::CellPoint> points;
        while (ranked.given() < set.cells()) {
            const auto part = ranked.next(portion);
            ASSERT_EQ(part.size(), std::min(portion, set.cells() - points.size()))
                << "as many as may be, and not more";
            points.insert(points.end(), part.begin(), part.end());
            ASSERT_EQ(ranked.given(), points.size());
        }
        ASSERT_TRUE(ranked.next(portion).empty());
        const Slots slots = ranked.take();
        std::size_t rank = 0;
        for (unsigned surface = 0; surface < set.surfaces.size(); ++surface)
            for (const index::CellPoint& from : set.surfaces[surface].points) {
                const index::CellPoint& point = points[rank];
                ASSERT_EQ((CellPlace{point.x, point.y, point.z, point.style}), slots.places[rank]);
                ASSERT_EQ(point.x, from.x);
                ASSERT_EQ(point.y, from.y);
                ASSERT_EQ(point.z, from.z);
                ASSERT_EQ(point.plane, from.plane);
                ASSERT_EQ(point.style & 7u, surface);
                ASSERT_EQ(point.style >> kColorShift, set.colors.empty() ? 0u : set.colors[rank]);
                ++rank;
            }
        ASSERT_EQ(slots.places.size(), rank);
        ASSERT_TRUE(slots.slot_of_rank.empty());
    }
}

} // namespace
} // namespace isochron::render
