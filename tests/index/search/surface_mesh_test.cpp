// A mesh in plain vectors is the mesh that is drawn, whole or by chunks, with values of other arrays.
#include "index/search/surface_mesh.h"

#include "index/error.h"
#include "index/extraction/extraction.h"
#include "index/file/color_source.h"
#include "index/indexing/index_build.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace isochron::index {
namespace {

constexpr double kNowhere = 1e9;

class SurfaceMeshTest : public testing::Test {
  protected:
    /// @return the same file twice: its steps as a whole, and in chunks
    std::array<std::shared_ptr<const IndexFile>, 2> indexed(const StepValues& values,
                                                            const TestField* colors = nullptr) {
        MemorySeries series(values);
        series.info().grid.origin = {10, -20, 30};
        series.info().grid.spacing = {0.5, 2, 1};
        std::optional<MemorySeries> second;
        if (colors) {
            second.emplace(colors->view());
            second->info().grid = series.info().grid;
        }
        const auto path = folder_.path() / "a.isochron";
        build_index(series, path, {.color = second ? &*second : nullptr});
        return {IndexFile::open(path), IndexFile::open(path, 1)};
    }

    test_support::TestFolder folder_;
    std::mt19937 random_{test_seed()};
};

TEST_F(SurfaceMeshTest, IsTheMeshThatIsDrawn) {
    for (const ValueType type : {ValueType::u8, ValueType::i16, ValueType::f32, ValueType::f64}) {
        const TestField field({37, 41, 39}, 2, type, scaled(turbulence(random_), 100, 10),
                              {random_() % 2 ? -0.5 : 2.0, 1.0});
        const double isovalue = quantiles(sorted_values(field.view()), 3)[1];
        const auto files = indexed(field.view());
        ASSERT_TRUE(files[0]->better_whole(1));
        ASSERT_FALSE(files[1]->better_whole(1));
        for (const auto& file : files) {
            const ExtractionPtr drawn = extract_from(file, std::nullopt, Shading::cells)(
                {.instant = Instant(1),
                 .isovalues = {isovalue},
                 .mesh_room = std::uint64_t{1} << 30},
                {});
            const CellMesh& mesh = *drawn->surfaces.front().mesh;
            ASSERT_GT(mesh.vertices.size(), 1000u);
            const SurfaceMesh surface = mesh_of(file, {Instant(1), isovalue}, {.normals = true});
            ASSERT_EQ(surface.points.size(), mesh.vertices.size());
            ASSERT_EQ(surface.normals.size(), mesh.vertices.size());
            ASSERT_EQ(3 * surface.triangles.size(), mesh.triangles.size());
            EXPECT_TRUE(surface.values.empty());
            for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
                const glm::dvec3 at = file->info().grid.physical(position_of(mesh.vertices[i]));
                const glm::dvec3 normal = normal_of(mesh.vertices[i]);
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const auto a = static_cast<int>(axis);
                    ASSERT_EQ(surface.points[i][axis], static_cast<float>(at[a]));
                    ASSERT_EQ(surface.normals[i][axis], static_cast<float>(normal[a]));
                }
            }
            for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
                ASSERT_EQ(surface.triangles[i / 3][i % 3], mesh.triangles[i]);
            EXPECT_TRUE(mesh_of(file, {Instant(1), isovalue}).normals.empty());
        }
    }
}

TEST_F(SurfaceMeshTest, InPiecesIsTheSame) {
    const TestField field({37, 41, 70}, 1, ValueType::f32, turbulence(random_));
    const double isovalue = quantiles(sorted_values(field.view()), 3)[1];
    const auto files = indexed(field.view());
    for (const auto& file : files) {
        SurfaceMeshes meshes(file);
        const std::optional<CellMesh> whole = meshes.make_packed({Instant(0), isovalue});
        CellMesh joined;
        std::size_t pieces = 0, before = 0; // vertices before the last piece
        ASSERT_TRUE(meshes.make_pieces({Instant(0), isovalue}, {}, [&](CellMesh piece) {
            for (const std::uint32_t corner : piece.triangles)
                ASSERT_GE(corner, before) << "in this piece or the one before it";
            before = joined.vertices.size();
            ++pieces;
            const auto append = [](auto& to, const auto& from) {
                to.insert(to.end(), from.begin(), from.end());
            };
            append(joined.vertices, piece.vertices);
            append(joined.triangles, piece.triangles);
            append(joined.cases, piece.cases);
        }));
        EXPECT_EQ(pieces, file == files[0] ? 1u : 5u) << "one for each layer of chunks";
        EXPECT_TRUE(joined == *whole);
    }
}

TEST_F(SurfaceMeshTest, HasTheValuesOfAnotherArrayWhereTheyAreAsked) {
    // Linear in space, so that interpolation along an edge is exact.
    const auto linear = [](double x, double y, double z, double t) {
        return 2 * x - 3 * y + z + 100 * t;
    };
    const TestField field({37, 41, 39}, 2, ValueType::f32, turbulence(random_));
    const TestField colors({37, 41, 39}, 2, ValueType::f64, linear);
    const double isovalue = quantiles(sorted_values(field.view()), 3)[1];
    for (const auto& file : indexed(field.view(), &colors)) {
        const SurfaceMesh surface = mesh_of(file, {Instant(1), isovalue}, {.values = 0});
        ASSERT_GT(surface.points.size(), 1000u);
        ASSERT_EQ(surface.values.size(), surface.points.size());
        for (std::size_t i = 0; i < surface.points.size(); ++i) {
            const auto& [x, y, z] = surface.points[i];
            const glm::dvec3 at = file->info().grid.index_of({x, y, z});
            ASSERT_NEAR(surface.values[i], linear(at.x, at.y, at.z, 1), 1e-3) << i;
        }
        EXPECT_THROW(mesh_of(file, {Instant(1), isovalue}, {.values = ColorSource::count(*file)}),
                     Error);
    }
}

TEST_F(SurfaceMeshTest, OfABallHasEverySideTwiceOnceEachWay) {
    const TestField field({40, 36, 50}, 1, ValueType::f32,
                          [](double x, double y, double z, double) {
                              return std::hypot(x - 19.3, y - 17.8, z - 24.6);
                          });
    for (const auto& file : indexed(field.view())) {
        const SurfaceMesh surface = mesh_of(file, {Instant(0), 15.0});
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
        for (const auto& [a, b, c] : surface.triangles)
            for (const auto& side : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
                EXPECT_EQ(++sides[side], 1);
        EXPECT_GT(sides.size(), 10000u);
        for (const auto& [side, times] : sides)
            ASSERT_TRUE(sides.contains({side.second, side.first}));
    }
}

TEST_F(SurfaceMeshTest, IsEmptyWhereNothingIsActiveAndGoneWhenItIsStopped) {
    const TestField field({20, 20, 20}, 1, ValueType::f32, turbulence(random_));
    for (const auto& file : indexed(field.view())) {
        EXPECT_TRUE(mesh_of(file, {Instant(0), kNowhere}, {.normals = true}).points.empty());
        EXPECT_TRUE(mesh_of(file, {Instant(0), std::nan("")}).triangles.empty());
        EXPECT_THROW(mesh_of(file, {Instant(1), 0.0}), Error) << "there is no such step";
        SurfaceMeshes meshes(file);
        std::stop_source stop;
        stop.request_stop();
        EXPECT_FALSE(meshes.make({Instant(0), 0.1}, {}, stop.get_token()));
        EXPECT_TRUE(meshes.make({Instant(0), 0.1})) << "the same work space";
    }
}

} // namespace
} // namespace isochron::index
