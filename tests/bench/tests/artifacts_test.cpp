// The pixels that kept normals and false positives change.
#include "tests/bench/measures/artifacts.h"

#include "index/scan/scan.h"
#include "tests/support/test_field.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

namespace isochron::bench {
namespace {

using index::Query;
using index::TestField;
using index::ValueType;

/// A row of pixels, as red and alpha.
render::Image picture(std::initializer_list<std::pair<int, int>> pixels) {
    render::Image image;
    image.width = static_cast<int>(pixels.size());
    image.height = 1;
    for (const auto& [red, alpha] : pixels)
        image.rgba.insert(image.rgba.end(), {std::uint8_t(red), 7, 7, std::uint8_t(alpha)});
    return image;
}

TEST(Artifacts, AreCountedOverPixelsThatShowSomething) {
    const render::Image a = picture({{10, 255}, {90, 255}, {200, 0}, {30, 255}, {0, 0}}),
                        b = picture({{10, 255}, {50, 255}, {0, 0}, {35, 255}, {40, 9}});
    const PixelDifference found = difference(a, b);
    EXPECT_DOUBLE_EQ(found.mean, (0 + 40 + 5 + 40) / 4.0);
    EXPECT_DOUBLE_EQ(found.p99, 40);
    EXPECT_DOUBLE_EQ(found.changed_percent, 50) << "by more than 5";
    EXPECT_EQ(difference(picture({{9, 0}}), picture({{0, 0}})).mean, 0.0);
    const render::Image marked = difference_picture(a, b, 4);
    EXPECT_EQ(int(marked.at(1, 0)[0]), 160);
    EXPECT_EQ(int(marked.at(1, 0)[2]), 160) << "gray";
    EXPECT_EQ(int(marked.at(2, 0)[1]), 255) << "as bright as it gets";
    const render::Image both = side_by_side({a, b});
    EXPECT_EQ(both.width, 10);
    EXPECT_EQ(int(both.at(6, 0)[0]), 50);
}

TEST(Artifacts, ComeFromTheNormalsOfTheMiddleOfTheSpanAndFromCandidates) {
    const TestField field({30, 28, 31}, 9, ValueType::u8, index::moving_sphere);
    const index::StepValues& values = field.view();
    const auto bytes = index::build_thi_tree(values, {.lattice = 16, .max_variation = 3});
    const index::ThiTree tree(bytes);
    const Query query{index::Instant(5), 112.5};
    const ArtifactSets sets = artifact_sets(values, tree, query);

    std::vector<index::CellId> active;
    index::scan(values, query, active);
    ASSERT_GT(active.size(), 200u);
    EXPECT_EQ(sets.exact->ids, active);
    EXPECT_EQ(sets.kept_normals->ids, active);
    const auto& found = sets.false_positives->ids;
    EXPECT_GT(found.size(), active.size());
    EXPECT_TRUE(std::includes(found.begin(), found.end(), active.begin(), active.end()));
    EXPECT_EQ(sets.false_positives->points.size(), found.size());

    std::size_t kept = 0, cells = 0;
    for (const SpanCells& span : span_cells(values, tree, query)) {
        index::CellSet stored;
        stored.query = {index::Instant(span.middle), query.isovalue};
        stored.ids = span.cells;
        std::sort(stored.ids.begin(), stored.ids.end());
        index::shade_cells(values, stored);
        for (std::size_t i = 0; i < stored.ids.size(); ++i) {
            const auto at = std::lower_bound(active.begin(), active.end(), stored.ids[i]);
            ASSERT_EQ(*at, stored.ids[i]);
            const auto& point =
                sets.kept_normals->points[static_cast<std::size_t>(at - active.begin())];
            EXPECT_EQ(point.plane & index::kNormalBits,
                      stored.points[i].plane & index::kNormalBits);
            EXPECT_EQ(point.x, stored.points[i].x);
            const auto& exact = sets.exact->points[static_cast<std::size_t>(at - active.begin())];
            EXPECT_EQ(point.plane & ~index::kNormalBits, exact.plane & ~index::kNormalBits);
            kept += point.plane != exact.plane;
        }
        cells += span.cells.size();
    }
    EXPECT_EQ(cells, active.size()) << "each cell is stored once";
    EXPECT_GT(kept, 20u) << "and some for longer than a step";
}

} // namespace
} // namespace isochron::bench
