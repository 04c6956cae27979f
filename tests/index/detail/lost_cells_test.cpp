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
    CellSet find(std::span<const CellPoint> drawn, std::span<const std::uint8_t> levels,
                 std::size_t most) {
        const DetailRegions regions(file_->info().grid);
        LayerSearch search(file_);
        CellSet found;
        EXPECT_TRUE(LostCells(*file_, regions, 0, search, most)
                        .find({Instant(0), 0.0}, drawn, levels, found, {}));
        return found;
    }

    test_support::TestFolder folder_;
    TestField field_;
    std::shared_ptr<const IndexFile> file_;
};

TEST_F(LostCellsTest, SpecksAndTubesThatNoLevelHasAreDrawnAsLargeAsTheyAre) {
    SurfacesQuery query{Instant(0), {0.0}};
    query.detail.most_cells = 3000;
    query.detail.wished.assign(DetailRegions(field_.view().grid).size(),
                               2 * DetailQuery::kPartsOfLevel);
    const ExtractionPtr found = extract_from(file_)(query, {});
    ASSERT_TRUE(found->coarse());
    ASSERT_GE(std::ranges::min(found->detail), 2);
    for (const CellPoint& p : found->surfaces[0].points)
        EXPECT_TRUE(slow_level(p) == 0 || found->detail[0] == slow_level(p));
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

TEST_F(LostCellsTest, OfTooManyChunksThoseWithNothingDrawnAreReadOrSomeOfThem) {
    const DetailRegions regions(file_->info().grid);
    const std::vector<std::uint8_t> levels(regions.size(), 2);
    CellSet coarse;
    coarse.query = {Instant(0), 0.0};
    ASSERT_TRUE(
        LayerSearch(file_).search(step_in_chunks(*file_, Instant(0), 2), coarse, true, true, {}));
    ASSERT_FALSE(coarse.points.empty());
    for (CellPoint& p : coarse.points)
        for (std::uint16_t* at : {&p.x, &p.y, &p.z})
            *at = static_cast<std::uint16_t>((2 * *at + 1) << 2);

    const auto all = lost_slowly(file_, {Instant(0), 0.0}, coarse.points, levels);
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

    CellSet found = find(coarse.points, levels, 1000);
    EXPECT_EQ(places(found.points, 2), places(all));
    EXPECT_EQ(found.ids.size(), found.points.size());
    std::vector<std::size_t> read; // chunks of which there are cells, by how many may be read
    std::multiset<LostPlace> fewer;
    for (const std::size_t most :
         {std::size_t{0}, chunks.size() / 4, chunks.size() / 2, chunks.size()}) {
        found = find(coarse.points, levels, most);
        std::set<SlowPlace> of;
        for (const CellPoint& p : found.points)
            of.insert({p.x / 16u, p.y / 16u, p.z / 16u});
        std::vector<CellPoint> wanted; // all of a chunk's lost cells or none of them
        for (const CellPoint& p : alone)
            if (of.contains({p.x / 32u, p.y / 32u, p.z / 32u}))
                wanted.push_back(p);
        const auto more = places(found.points, 2);
        EXPECT_EQ(more, places(wanted)) << most;
        EXPECT_TRUE(std::ranges::includes(more, fewer)) << "the same chunks, and others";
        fewer = more;
        read.push_back(of.size());
    }
    EXPECT_EQ(read[0], 0u);
    EXPECT_LT(0u, read[1]);
    EXPECT_LT(read[1], read[2]);
    EXPECT_LT(read[2], read[3]);
    bool all_alone = false; // with room for these, but not for those in which something is drawn
    for (std::size_t most = chunks.size(); most <= 2 * chunks.size(); most += 4)
        all_alone |= places(find(coarse.points, levels, most).points, 2) == places(alone);
    EXPECT_TRUE(all_alone);
}

} // namespace
} // namespace isochron::index
