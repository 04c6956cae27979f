// Grids that become regular ones: by how many vertices, and what the note says of the error.
#include "index/readers/formats/open_series.h"
#include "index/readers/formats/series/resampled_series.h"
#include "tests/support/reader_fixtures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace isochron::index {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// Hexahedra between points at these places along each axis, whose values are x * x.
std::string unstructured(const std::vector<double>& at) {
    const std::size_t n = at.size(), cells = (n - 1) * (n - 1) * (n - 1);
    std::string points, values, corners, types;
    for (const double z : at)
        for (const double y : at)
            for (const double x : at) {
                points += fmt::format("{} {} {}\n", x, y, z);
                values += fmt::format("{}\n", x * x);
            }
    for (std::size_t z = 0; z + 1 < n; ++z)
        for (std::size_t y = 0; y + 1 < n; ++y)
            for (std::size_t x = 0; x + 1 < n; ++x) {
                const std::size_t i = (z * n + y) * n + x, up = n * n;
                corners += fmt::format("8 {} {} {} {} {} {} {} {}\n", i, i + 1, i + 1 + n, i + n,
                                       i + up, i + up + 1, i + up + 1 + n, i + up + n);
                types += "12\n";
            }
    return fmt::format("# vtk DataFile Version 3.0\nu\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                       "POINTS {} double\n{}CELLS {} {}\n{}CELL_TYPES {}\n{}POINT_DATA {}\n"
                       "SCALARS s double 1\nLOOKUP_TABLE default\n{}",
                       n * n * n, points, cells, 9 * cells, corners, cells, types, n * n * n,
                       values);
}

SeriesInfo info_of(const std::filesystem::path& file,
                   const std::array<std::uint32_t, 3>& resample) {
    ReadOptions options;
    options.resample = resample;
    return open_series({file}, options)->info();
}

TEST(Resampled, NotesTheErrorAtTheSourcesPoints) {
    TestFolder folder;
    const auto file = folder.write("u.vtk", unstructured({0, 1, 2, 3, 4}));
    EXPECT_THAT(info_of(file, {5, 5, 5}).notes,
                Contains(HasSubstr("onto 5 x 5 x 5 vertices; at its points these are")));
    // At 0, 2 and 4 nothing is lost; at 1 and 3 the chord of x * x lies 1 above, of a range of 16.
    EXPECT_THAT(info_of(file, {3, 3, 3}).notes, Contains(HasSubstr("6.2 % of the values' range")));
    EXPECT_THAT(info_of(file, {9, 9, 9}).notes, testing::Not(Contains(HasSubstr("6.2 %"))));
}

TEST(Resampled, ByTheSmallestCellKeepsAllOfIt) {
    TestFolder folder;
    const auto file = folder.write("u.vtk", unstructured({0, 0.5, 2, 4}));
    EXPECT_EQ(info_of(file, kBySmallestCell).grid.vertices,
              (std::array<std::uint32_t, 3>{9, 9, 9}));
    const auto tiny = folder.write("t.vtk", unstructured({0, 1e-5, 1}));
    EXPECT_THAT(error_of([&] { info_of(tiny, kBySmallestCell); }),
                HasSubstr("t.vtk: its smallest cell asks for 100001 x 100001 x 100001 vertices"));
}

TEST(Resampled, RectilinearGridsToo) {
    TestFolder folder;
    const auto file = folder.write(
        "r.vtk", "# vtk DataFile Version 3.0\nr\nASCII\nDATASET RECTILINEAR_GRID\n"
                 "DIMENSIONS 3 2 2\nX_COORDINATES 3 float\n0 1 4\nY_COORDINATES 2 float\n0 2\n"
                 "Z_COORDINATES 2 float\n0 5\nPOINT_DATA 12\nSCALARS s float 1\n"
                 "LOOKUP_TABLE default\n0 1 4 0 1 4 0 1 4 0 1 4\n");
    const SeriesInfo info = info_of(file, kBySmallestCell);
    EXPECT_EQ(info.grid.vertices, (std::array<std::uint32_t, 3>{5, 2, 2}));
    EXPECT_EQ(info.grid.spacing, glm::dvec3(1, 2, 5));
    EXPECT_THAT(info.notes, Contains(HasSubstr("at most 0 % of the values' range off")));
}

} // namespace
} // namespace isochron::index
