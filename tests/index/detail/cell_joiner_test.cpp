// Small cells are joined as their definition says, whatever their order, and until it is stopped.
#include "index/detail/cell_joiner.h"

#include "index/detail/detail_regions.h"
#include "index/file/chunks/chunk_store.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <tuple>
#include <vector>

namespace isochron::index {
namespace {

/// Cells of some levels in a cube of 64 cells of level 0; some twice, which changes nothing.
JoinedCells some_cells(std::mt19937& random, unsigned least_level, unsigned levels) {
    JoinedCells cells;
    for (int i = 0; i < 3000; ++i) {
        const unsigned level = least_level + static_cast<unsigned>(random()) % levels;
        const auto at = [&] {
            return static_cast<std::uint16_t>(
                doubled_center(static_cast<std::uint32_t>(random()) % (64u >> level), level));
        };
        const auto plane = [&] {
            const auto side = [&] { return std::uniform_real_distribution<>(-1, 1)(random); };
            return pack({glm::normalize(glm::dvec3(side(), side(), side())), 0.0});
        };
        const CellPoint point{at(), at(), at(), 0, random() % 4 == 0 ? 0 : plane()};
        cells.points.push_back(point);
        cells.colors.push_back(static_cast<std::uint16_t>(random()));
    }
    return cells;
}

void sort_by_z(JoinedCells& cells) {
    std::ranges::stable_sort(cells.points, {}, &CellPoint::z);
}

/// What the definition says, cell by cell.
JoinedCells join_by_definition(const JoinedCells& cells, unsigned level) {
    JoinedCells made;
    std::map<std::array<unsigned, 3>, std::vector<std::size_t>> members; // by z, y, x
    for (std::size_t i = 0; i < cells.points.size(); ++i) {
        const CellPoint& p = cells.points[i];
        const unsigned own = level_of_center(p.x);
        if (own >= level) {
            made.points.push_back(p);
            made.colors.push_back(cells.colors[i]);
            continue;
        }
        const auto parent = [&](unsigned at) { return (at - (1u << own)) / 2 >> level; };
        members[{parent(p.z), parent(p.y), parent(p.x)}].push_back(i);
    }
    for (const auto& [at, of_cell] : members) {
        glm::dvec3 sum(0.0);
        for (const std::size_t i : of_cell)
            sum += unpack_plane(cells.points[i].plane).normal;
        const double length = glm::length(sum);
        const bool ball = length < 0.5 * static_cast<double>(of_cell.size());
        const auto middle = [&](std::size_t axis) {
            return static_cast<std::uint16_t>((2 * at[axis] + 1) << level);
        };
        made.points.push_back(
            {middle(2), middle(1), middle(0), 0, ball ? 0 : pack({sum / length, 0.0})});
        made.colors.push_back(cells.colors[of_cell[of_cell.size() / 2]]);
    }
    return made;
}

void expect_joined(const JoinedCells& cells) {
    CellJoiner joiner(cells, {});
    for (unsigned level = 0; level < 7; ++level, joiner.rise()) {
        ASSERT_EQ(level, joiner.level());
        const JoinedCells expected = join_by_definition(cells, level), made = joiner.join();
        ASSERT_EQ(expected.points.size(), joiner.cells()) << level;
        EXPECT_EQ(expected.colors, made.colors) << level;
        ASSERT_EQ(expected.points.size(), made.points.size()) << level;
        for (std::size_t i = 0; i < made.points.size(); ++i) {
            const CellPoint &e = expected.points[i], &m = made.points[i];
            EXPECT_EQ(std::tie(e.x, e.y, e.z, e.plane), std::tie(m.x, m.y, m.z, m.plane)) << level;
        }
    }
}

TEST(CellJoiner, JoinsCellsOfOneLevelAndOfSeveralInAnyOrder) {
    std::mt19937 random(test_seed());
    for (const unsigned levels : {1u, 3u}) {
        JoinedCells cells = some_cells(random, 0, levels);
        expect_joined(cells);
        sort_by_z(cells);
        expect_joined(cells);
        expect_joined(some_cells(random, 2, levels));
    }
    expect_joined({});
}

TEST(CellJoiner, StopsWhenAskedTo) {
    std::mt19937 random(test_seed());
    std::stop_source stop;
    CellJoiner joiner(some_cells(random, 0, 1), stop.get_token());
    joiner.rise();
    stop.request_stop();
    EXPECT_THROW(joiner.rise(), Stopped);
    EXPECT_THROW(joiner.join(), Stopped);
}

} // namespace
} // namespace isochron::index
