// What an export makes for its format, and nothing more.
#include "index/export/surface_export.h"

#include "index/indexing/index_build.h"
#include "index/search/surface_mesh.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

namespace isochron::index {
namespace {

/// The table of a step's cells as they are found on the way to a mesh.
void write_cells_beside_mesh(const std::shared_ptr<const IndexFile>& file, const SurfaceWish& wish,
                             std::uint32_t number, const std::filesystem::path& name) {
    CellSet cells;
    const auto mesh = SurfaceMeshes(file).make_packed({Instant(number), wish.isovalue},
                                                      {.normals = true}, {}, &cells);
    ASSERT_GT(mesh->triangles.size(), 1000u);
    ExportedStep step{.instant = Instant(number), .grid = &file->info().grid, .surfaces = {}};
    step.surfaces.push_back(
        {.name = wish.name, .cells = &cells, .isovalue = wish.isovalue, .color_of = nullptr});
    step.time = file->info().times[number];
    ExportPlan plan;
    plan.steps = {number};
    surface_format("csv")->make(plan, name)->add(step);
}

TEST(SurfaceExport, OfCellsMakesNoMesh) {
    const test_support::TestFolder folder;
    std::mt19937 random(test_seed());
    const TestField field({37, 41, 39}, 2, ValueType::i16, scaled(turbulence(random), 100, 10));
    MemorySeries series(field.view());
    series.info().grid.spacing = {0.5, 2, 1};
    build_index(series, folder.path() / "a.isochron", {});
    const std::uint64_t small = 1; // [byte] of steps that are read as a whole
    for (const auto& file : {IndexFile::open(folder.path() / "a.isochron"),
                             IndexFile::open(folder.path() / "a.isochron", small)}) {
        ExportRequest request;
        request.plan.steps = {1};
        request.surfaces = {
            {.isovalue = quantiles(sorted_values(field.view()), 3)[1], .name = "s"}};
        const ExportCount count =
            export_surfaces(file, *surface_format("csv"), folder.path() / "c.csv", request);
        EXPECT_EQ(count.vertices, 0u);
        EXPECT_EQ(count.triangles, 0u);
        EXPECT_TRUE(count.empty_steps.empty());
        write_cells_beside_mesh(file, request.surfaces.front(), 1, folder.path() / "same.csv");
        const std::string table = folder.read("c.csv");
        EXPECT_EQ(static_cast<std::uint64_t>(std::ranges::count(table, '\n')), count.cells + 1);
        EXPECT_TRUE(table == folder.read("same.csv"));
    }
}

} // namespace
} // namespace isochron::index
