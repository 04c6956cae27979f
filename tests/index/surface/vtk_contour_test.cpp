// The surface of a rectilinear grid has the places of VTK's contour of the same file.
#include "index/extraction/extraction.h"
#include "index/indexing/index_build.h"
#include "index/readers/formats/open_series.h"
#include "index/volume/volume_series.h"
#include "tests/support/paths.h"
#include "tests/support/test_folder.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace isochron::index {
namespace {

/// Distance of each place from the nearest of the others, at most.
double farthest_from(const std::vector<glm::dvec3>& places, const std::vector<glm::dvec3>& others) {
    double most = 0;
    for (const glm::dvec3& place : places) {
        double nearest = HUGE_VAL;
        for (const glm::dvec3& other : others)
            nearest = std::min(nearest, glm::distance(place, other));
        most = std::max(most, nearest);
    }
    return most;
}

TEST(Rectilinear, SurfacesHaveThePlacesOfVtksContour) {
    constexpr double kIsovalue = 0.3;
    const test_support::TestFolder folder;
    const std::string command = fmt::format(
        "PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 {}/tests/index/surface/contour_of_vtk.py {} "
        "{}",
        test_support::source_root(), folder.path().string(), kIsovalue);
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::string bytes = folder.read("contour.bin");
    std::vector<glm::dvec3> expected(bytes.size() / sizeof(glm::dvec3));
    std::memcpy(expected.data(), bytes.data(), expected.size() * sizeof(glm::dvec3));

    const auto series = open_series({folder.path() / "grid.vtr"});
    const auto path = folder.path() / "a.isochron";
    build_index(*series, path, {});
    const auto file = IndexFile::open(path);
    const Grid& grid = file->info().grid;
    EXPECT_TRUE(grid.rectilinear());
    const ExtractionPtr shown = extract_from(file, std::nullopt, Shading::cells)(
        {.instant = Instant(0), .isovalues = {kIsovalue}, .mesh_room = 1 << 28}, {});
    ASSERT_TRUE(shown);
    ASSERT_TRUE(shown->surfaces.front().mesh);
    std::vector<glm::dvec3> places;
    for (const MeshVertex& vertex : shown->surfaces.front().mesh->vertices)
        places.push_back(grid.physical(position_of(vertex)));

    ASSERT_GT(expected.size(), 1000u);
    EXPECT_EQ(places.size(), expected.size());
    EXPECT_LT(farthest_from(places, expected), 1e-5);
    EXPECT_LT(farthest_from(expected, places), 1e-5);
}

} // namespace
} // namespace isochron::index
