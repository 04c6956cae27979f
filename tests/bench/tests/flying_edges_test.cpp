// VTK's flying edges contour the very cells that the index calls active.
#include "tests/bench/rivals/flying_edges.h"

#include "index/scan/scan.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <vector>

namespace isochron::bench {
namespace {

using index::TestField;
using index::ValueType;

std::size_t active_cells(const index::StepValues& values, const index::Query& query) {
    std::vector<index::CellId> cells;
    index::scan(values, query, cells);
    return cells.size();
}

TEST(FlyingEdges, ContoursTheActiveCellsOfEveryStepAndType) {
    for (const ValueType type : {ValueType::u8, ValueType::i16, ValueType::f32, ValueType::f64}) {
        // Shrinks so much that no step could be taken for another.
        const TestField field({40, 38, 41}, 3, type, [](double x, double y, double z, double t) {
            return (1 - 0.25 * t) * index::moving_sphere(x, y, z, t);
        });
        const auto edges = flying_edges(field.view());
        for (const double isovalue : {100.0, 112.5, 180.0, 300.0})
            for (const std::uint32_t step : {2u, 0u, 1u}) {
                const std::size_t cells =
                    active_cells(field.view(), {index::Instant(step), isovalue});
                const auto surface = edges->contour({index::Instant(step), isovalue}, false);
                // A surface in a cell has one to five triangles; a closed one has V - F / 2 = 2.
                EXPECT_GE(surface.triangles, cells);
                EXPECT_LE(surface.triangles, 5 * cells);
                if (cells > 0)
                    EXPECT_EQ(surface.vertices, surface.triangles / 2 + 2);
                else
                    EXPECT_EQ(surface.triangles, 0u);
            }
    }
}

TEST(FlyingEdges, ComputesNormalsOnlyWhenAsked) {
    const TestField field({40, 38, 41}, 1, ValueType::u8, index::moving_sphere);
    const auto edges = flying_edges(field.view());
    EXPECT_EQ(edges->contour({index::Instant(0), 112.5}, false).normals, 0u);
    const auto surface = edges->contour({index::Instant(0), 112.5}, true);
    EXPECT_EQ(surface.normals, surface.vertices);
    EXPECT_GT(surface.normals, 1000u);
}

TEST(FlyingEdges, ComparesTheIsovalueAfterScaling) {
    const TestField field({40, 38, 41}, 1, ValueType::i16, index::moving_sphere, {-2, 10});
    const auto edges = flying_edges(field.view());
    const std::size_t cells = active_cells(field.view(), {index::Instant(0), 10 - 2 * 112.5});
    EXPECT_GT(cells, 1000u);
    EXPECT_GE(edges->contour({index::Instant(0), 10 - 2 * 112.5}, false).triangles, cells);
    EXPECT_LE(edges->contour({index::Instant(0), 10 - 2 * 112.5}, false).triangles, 5 * cells);
}

} // namespace
} // namespace isochron::bench
