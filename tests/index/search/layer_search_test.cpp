// Work on chunks gives the same result as work on whole steps, for grids of any size.
#include "index/error.h"
#include "index/extraction/extraction.h"
#include "index/extraction/value_in_index.h"
#include "index/indexing/index_build.h"
#include "index/search/index_search.h"
#include "index/search/layer_search.h"
#include "index/volume/sample.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace isochron::index {
namespace {

/// So small that no step is worked on as a whole, and that chunks are dropped and read again.
constexpr std::uint64_t kNoRoom = 1;

/// Around the edge of a chunk, primes, and the smallest there is.
constexpr std::array<std::array<std::uint32_t, 3>, 7> kChunkyGrids{
    {{2, 2, 2}, {16, 16, 16}, {17, 17, 17}, {18, 33, 31}, {37, 23, 41}, {2, 50, 19}, {70, 3, 34}}};

constexpr std::array kEveryWay{SearchMethod::bricks, SearchMethod::tree, SearchMethod::scan};

class LayerSearchTest : public testing::Test {
  protected:
    /// @return the same file twice: its steps as a whole, and in chunks
    std::array<std::shared_ptr<const IndexFile>, 2> indexed(const StepValues& values,
                                                            Codec codec = Codec::fitting) {
        MemorySeries series(values);
        const auto path = folder_.path() / "a.isochron";
        build_index(series, path,
                    {.tiers = TierSet().with(Tier::bricks).with(Tier::tree), .codec = codec});
        return {IndexFile::open(path), IndexFile::open(path, kNoRoom)};
    }

    test_support::TestFolder folder_;
    std::mt19937 random_{test_seed()};
};

CellMesh mesh_of_cells(const std::shared_ptr<const IndexFile>& file, const CellSet& set) {
    CellMesh mesh;
    EXPECT_TRUE(LayerSearch(file).make_mesh(step_of(*file, set.query.instant), set, mesh, {}));
    return mesh;
}

void expect_same(const CellSet& a, const CellSet& b) {
    ASSERT_EQ(a.ids, b.ids);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        const CellPoint &p = a.points[i], &q = b.points[i];
        ASSERT_TRUE(p.x == q.x && p.y == q.y && p.z == q.z && p.plane == q.plane) << "cell " << i;
    }
    ASSERT_EQ(a.rows.size(), b.rows.size());
    for (std::size_t i = 0; i < a.rows.size(); ++i)
        ASSERT_TRUE(a.rows[i].y == b.rows[i].y && a.rows[i].z == b.rows[i].z &&
                    a.rows[i].begin == b.rows[i].begin);
}

TEST_F(LayerSearchTest, FindsAndShadesWhatWholeStepsGiveForEveryTypeMethodAndGrid) {
    for (const auto& vertices : kChunkyGrids)
        for (const ValueType type : kAllTypes) {
            const bool noise = random_() % 2;
            const TestField field(
                vertices, 2, type,
                scaled(noise ? white_noise(random_) : turbulence(random_), 100, 10),
                {random_() % 2 ? -0.5 : 2.0, 1.0});
            const StepValues values = field.view();
            const auto [whole, chunks] = indexed(values);
            ASSERT_TRUE(whole->better_whole(0));
            ASSERT_FALSE(chunks->better_whole(0));
            const auto isovalues = quantiles(sorted_values(values), 3);
            for (const SearchMethod method : kEveryWay)
                for (const double isovalue : isovalues) {
                    SCOPED_TRACE(testing::Message()
                                 << name_of(type) << " " << vertices[0] << " x " << vertices[1]
                                 << " x " << vertices[2] << " method " << int(method)
                                 << " isovalue " << isovalue << " noise " << noise);
                    const Query query{Instant(static_cast<std::uint32_t>(random_() % 2)), isovalue};
                    const CellSetPtr found = search_in(chunks, method, Shading::cells)(query, {});
                    ASSERT_EQ(found->ids, BruteForce(values, query.instant.step).active(isovalue));
                    const CellSetPtr wanted = search_in(whole, method, Shading::cells)(query, {});
                    expect_same(*found, *wanted);
                    const CellMesh mesh = mesh_of_cells(chunks, *found);
                    ASSERT_EQ(mesh.triangles.empty(), found->ids.empty());
                    EXPECT_TRUE(mesh == mesh_of_cells(whole, *wanted));
                }
        }
}

TEST_F(LayerSearchTest, CellsWithNaNAreNotActive) {
    TestField field({35, 34, 33}, 1, ValueType::f32, turbulence(random_));
    for (int i = 0; i < 60; ++i)
        field.at<float>(0, random_() % (35 * 34 * 33)) = std::nanf("");
    for (const std::size_t corner : {std::size_t{0}, std::size_t{35 * 34 * 33 - 1}})
        field.at<float>(0, corner) = std::nanf("");
    const StepValues values = field.view();
    const auto chunks = indexed(values)[1];
    for (const double isovalue : {-0.3, 0.0, 0.2})
        for (const SearchMethod method : {SearchMethod::bricks, SearchMethod::scan})
            EXPECT_EQ(search_in(chunks, method, Shading::none)({Instant(0), isovalue}, {})->ids,
                      BruteForce(values, 0).active(isovalue));
}

TEST_F(LayerSearchTest, EveryCodecGivesTheSameCells) {
    for (const ValueType type : kAllTypes) {
        const TestField field({33, 20, 18}, 2, type, scaled(turbulence(random_), 100, 10));
        const StepValues values = field.view();
        const double isovalue = quantiles(sorted_values(values), 3)[1];
        for (const Codec codec : {Codec::none, Codec::lz4, Codec::zstd}) {
            const auto [whole, chunks] = indexed(values, codec);
            for (std::size_t t = 0; t < 2; ++t)
                ASSERT_TRUE(std::ranges::equal(whole->values().step_bytes(t), values.step_bytes(t)))
                    << name_of(type);
            EXPECT_EQ(search_in(chunks, SearchMethod::bricks)({Instant(1), isovalue}, {})->ids,
                      BruteForce(values, 1).active(isovalue));
            EXPECT_NO_THROW(chunks->verify());
        }
    }
}

TEST_F(LayerSearchTest, ExtractionsAreThoseOfWholeSteps) {
    for (const ValueType type : kAllTypes) {
        const TestField field({41, 37, 35}, 2, type, scaled(turbulence(random_), 100, 10));
        const TestField temperature({41, 37, 35}, 2, ValueType::f32, turbulence(random_));
        MemorySeries series(field.view()), colors(temperature.view());
        const auto path = folder_.path() / "b.isochron";
        build_index(series, path, {.color = &colors});
        const auto isovalues = quantiles(sorted_values(field.view()), 4);
        const SurfacesQuery query{Instant(1), {isovalues[1], isovalues[2]}, CellColoring::value};
        const ExtractionPtr whole = extract_from(IndexFile::open(path))(query, {});
        const ExtractionPtr chunks = extract_from(IndexFile::open(path, kNoRoom))(query, {});
        for (std::size_t i = 0; i < 2; ++i)
            ASSERT_EQ(whole->surfaces[i].ids, chunks->surfaces[i].ids);
        EXPECT_GT(whole->cells(), 0u);
        EXPECT_EQ(whole->colors, chunks->colors);
        EXPECT_FALSE(whole->surroundings.shares.empty());
        EXPECT_EQ(whole->surroundings.shares, chunks->surroundings.shares);
        EXPECT_EQ(whole->blocks.ids, chunks->blocks.ids);
        EXPECT_EQ(whole->blocks.joined(), chunks->blocks.joined());
        EXPECT_TRUE(whole->blocks.digests == chunks->blocks.digests);
    }
}

TEST_F(LayerSearchTest, AStoppedSearchGivesNothing) {
    const TestField field({20, 20, 40}, 1, ValueType::f32, moving_sphere);
    const auto chunks = indexed(field.view())[1];
    std::stop_source stop;
    stop.request_stop();
    for (const SearchMethod method : kEveryWay)
        EXPECT_EQ(search_in(chunks, method)({Instant(0), 150.0}, stop.get_token()), nullptr);
}

TEST(ValueInIndex, OfALargeStepIsThatOfItsChunks) {
    std::mt19937 random(test_seed());
    test_support::TestFolder folder;
    TestField field({251, 97, 101}, 2, ValueType::f32, turbulence(random), {2, -1});
    field.at<float>(1, 251 * 97 * 50 + 5) = std::nanf("");
    MemorySeries series(field.view());
    series.info().grid.origin = {1, 2, 3};
    series.info().grid.spacing = {0.5, 2, 1};
    build_index(series, folder.path() / "a", {});
    const auto file = IndexFile::open(folder.path() / "a");
    ASSERT_FALSE(file->better_whole(1));
    StepValues values = field.view();
    values.grid = series.info().grid;
    std::uniform_real_distribution<double> along(-0.02, 1.02);
    int found = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 at(1 + 125 * along(random), 2 + 192 * along(random),
                            3 + 100 * along(random));
        const auto value = value_in(*file, Instant(1), at);
        EXPECT_EQ(value, value_at(values, 1, at));
        found += value.has_value();
    }
    EXPECT_GT(found, 1500);
}

} // namespace
} // namespace isochron::index
