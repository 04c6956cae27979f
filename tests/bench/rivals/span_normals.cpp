// The error of normals that are stored once for a time span.
#include "tests/bench/rivals/span_normals.h"

#include "index/paper/time_tree.h"
#include "index/scan/scan.h"
#include "index/surface/cell_set.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace isochron::bench {

using index::CellId;
using index::TimeNode;

std::vector<SpanCells> span_cells(const index::StepValues& values, const index::ThiTree& tree,
                                  const index::Query& query) {
    const index::KeyMap keys(values.type, values.scaling);
    index::ThiTree::Cursor cursor; // says at which depth each cell was found
    tree.search_incremental(cursor, query.instant.step, keys.threshold(query.isovalue));
    std::vector<SpanCells> spans;
    TimeNode node = TimeNode::root(tree.steps());
    std::size_t begin = 0;
    for (const std::size_t end : cursor.reached) {
        SpanCells& span = spans.emplace_back();
        span.middle = node.first + node.steps() / 2;
        span.cells.assign(cursor.cells.begin() + static_cast<std::ptrdiff_t>(begin),
                          cursor.cells.begin() + static_cast<std::ptrdiff_t>(end));
        index::keep_active(values, query, span.cells);
        begin = end;
        if (!node.is_leaf())
            node = node.towards(query.instant.step);
    }
    return spans;
}

NormalError normal_error(const index::StepValues& values, const index::ThiTree& tree,
                         double isovalue) {
    std::vector<double> angles;
    for (std::uint32_t step = 0; step < values.steps; ++step)
        for (const SpanCells& span : span_cells(values, tree, {index::Instant(step), isovalue}))
            for (const CellId cell : span.cells) {
                const glm::dvec3 now = index::cell_normal(values, step, cell),
                                 stored = index::cell_normal(values, span.middle, cell);
                if (now != glm::dvec3(0) && stored != glm::dvec3(0))
                    angles.push_back(
                        glm::degrees(std::acos(std::clamp(glm::dot(now, stored), -1.0, 1.0))));
            }
    if (angles.empty())
        return {};
    const auto p99 = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() * 99 / 100);
    std::nth_element(angles.begin(), p99, angles.end());
    return {std::accumulate(angles.begin(), angles.end(), 0.0) / static_cast<double>(angles.size()),
            *p99};
}

} // namespace isochron::bench
