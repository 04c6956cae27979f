// What levels of detail lose is found, exactly where chunks are read, and never reads too many.
#include "index/detail/lost_cells.h"
#include "index/extraction/extraction.h"
#include "index/indexing/index_build.h"
#include "tests/index/detail/lost_slowly.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace isochron::index {
namespace {

/// A ball, specks on a coarse lattice that are as large as a few voxels, and a thin tube.
double specks(double x, double y, double z, double) {
    const double ball = 22 - std::hypot(x - 46, y - 50, z - 47);
    const auto to_lattice = [](double at) { return at - 19 * std::round(at / 19); };
    const double speck = 1.4 - std::hypot(to_lattice(x), to_lattice(y), to_lattice(z));
    const double tube = 1.2 - std::hypot(x - 85, y - 30);
    return std::max({ball, speck, tube});
}

using LostPlace = std::tuple<unsigned, unsigned, unsigned, std::uint32_t>;
std::multiset<LostPlace> places(std::span<const CellPoint> points, unsigned doubled = 1) {
    std::multiset<LostPlace> all;
    for (const CellPoint& p : points)
        all.emplace(doubled * p.x + doubled - 1, doubled * p.y + doubled - 1,
                    doubled * p.z + doubled - 1, p.plane);
    return all;
}

class LostCellsTest : public testing::Test {
  protected:
    LostCellsTest() : field_({97, 98, 95}, 1, ValueType::f32, specks) {
        MemorySeries series(field_.view());
        build_index(series, folder_.path() / "a", {.tiers = TierSet().with(Tier::bricks)});
        file_ = IndexFile::open(folder_.path() / "a", 1);
    }
    LostCells::Found find(std::span<const CellPoint> drawn, std::span<const std::uint8_t> levels,
                          std::size_t most) {
        const DetailRegions regions(file_->info().grid);
        LayerSearch search(file_);
        LostCells::Found found;
        EXPECT_TRUE(
            LostCells(*file_, regions, 0, search, most).find({0, 0.0}, drawn, levels, found, {}));
        return found;
    }

    test_support::TestFolder folder_;
    TestField field_;
    std::shared_ptr<const IndexFile> file_;
};

TEST_F(LostCellsTest, SpecksAndTubesThatNoLevelHasAreDrawn) {
    SurfacesQuery query{0, {0.0}};
    query.detail.most_cells = 600;
    const ExtractionPtr found = extract_from(file_)(query, {});
    ASSERT_TRUE(found->coarse());
    ASSERT_GE(std::ranges::min(found->detail), 2);
    const auto drawn_at = [&](double x, double y, double z) {
        return std::ranges::any_of(found->surfaces[0].points, [&](const CellPoint& p) {
            const double half = std::exp2(slow_level(p)) / 2;
            return std::abs(p.x / 2.0 - x) <= half + 2 && std::abs(p.y / 2.0 - y) <= half + 2 &&
                   std::abs(p.z / 2.0 - z) <= half + 2;
        });
    };
    for (int z = 0; z < 95; z += 19) {
        EXPECT_TRUE(drawn_at(85, 30, z)) << "the tube at " << z;
        for (int y = 0; y < 98; y += 19)
            for (int x = 0; x < 97; x += 19)
                if (std::hypot(x - 46, y - 50, z - 47) > 24) {
                    EXPECT_TRUE(drawn_at(x, y, z)) << x << " " << y << " " << z;
                }
    }
}

TEST_F(LostCellsTest, WhereTheyAreTooManyChunksWithNothingDrawnAreReadOrCountAsCells) {
    const DetailRegions regions(file_->info().grid);
    const std::vector<std::uint8_t> levels(regions.size(), 2);
    CellSet coarse;
    coarse.query = {0, 0.0};
    ASSERT_TRUE(LayerSearch(file_).search(step_in_chunks(*file_, 0, 2), coarse, true, true, {}));
    ASSERT_FALSE(coarse.points.empty());
    for (CellPoint& p : coarse.points)
        for (std::uint16_t* at : {&p.x, &p.y, &p.z})
            *at = static_cast<std::uint16_t>((2 * *at + 1) << 2);

    const auto all = lost_slowly(file_, {0, 0.0}, coarse.points, levels);
    const auto held = slow_drawn(file_->info().grid, coarse.points, 2);
    std::vector<CellPoint> alone;
    std::set<SlowPlace> chunks;
    for (const CellPoint& p : all) {
        const SlowPlace chunk{p.x / 32u, p.y / 32u, p.z / 32u};
        bool any = false;
        for (unsigned i = 0; i < 64; ++i)
            any |= held.contains(
                {4 * chunk[0] + i % 4, 4 * chunk[1] + i / 4 % 4, 4 * chunk[2] + i / 16});
        if (any)
            continue;
        alone.push_back(p);
        chunks.insert(chunk);
    }
    ASSERT_GT(all.size(), alone.size());
    ASSERT_GT(alone.size(), 100u);

    LostCells::Found found = find(coarse.points, levels, 1000);
    EXPECT_EQ(places(found.cells.points, 2), places(all));
    EXPECT_EQ(found.cells.ids.size(), found.cells.points.size());
    EXPECT_TRUE(found.chunks.empty());
    found = find(coarse.points, levels, 1);
    EXPECT_TRUE(found.cells.points.empty());
    std::set<SlowPlace> whole;
    for (const CellPoint& p : found.chunks) {
        EXPECT_EQ(slow_level(p), 4u);
        EXPECT_EQ(p.plane, 0u);
        whole.insert({p.x / 32u, p.y / 32u, p.z / 32u});
    }
    EXPECT_EQ(whole.size(), found.chunks.size());
    for (const SlowPlace& chunk : chunks)
        EXPECT_TRUE(whole.contains(chunk)) << "that has lost cells";
    EXPECT_LE(whole.size(), 2 * chunks.size());
    const LostCells::Found as_many = find(coarse.points, levels, whole.size());
    EXPECT_EQ(places(as_many.cells.points, 2), places(alone));
    EXPECT_TRUE(as_many.chunks.empty());
}

} // namespace
} // namespace isochron::index
