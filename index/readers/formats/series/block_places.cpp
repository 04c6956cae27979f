// Places blocks in a grid.
#include "index/readers/formats/series/block_places.h"

#include "index/error.h"
#include "index/readers/formats/stored_file.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace isochron::index {
namespace {

using Begin = std::array<std::int64_t, 3>;

bool near(const glm::dvec3& a, const glm::dvec3& b) {
    constexpr double kSlack = 1e-5;
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(a[axis] - b[axis]) <= kSlack * std::abs(b[axis]) + 1e-12))
            return false;
    return true;
}

/// The way from the first block's first vertex to another block's first vertex, in vertices.
Begin way_to(const Grid& block, const std::string& name, const Grid& first,
             const std::string& first_name) {
    if (block.rectilinear())
        throw Error("{}: its vertices are not even, expected parts of a regular grid", name);
    if (!near(block.spacing, first.spacing) || block.direction != first.direction)
        throw Error("{}: another spacing or direction than {}", name, first_name);
    const glm::dvec3 way =
        glm::transpose(first.direction) * (block.origin - first.origin) / first.spacing;
    constexpr double kOff = 1e-3, kMostAway = 1e6; // shares of a cell
    Begin begin{};
    for (int axis = 0; axis < 3; ++axis) {
        const double at = std::round(way[axis]);
        if (!(std::abs(way[axis] - at) <= kOff) || !(std::abs(at) < kMostAway))
            throw Error("{}: begins {} cells from {} along axis {}, expected a whole number", name,
                        way[axis], first_name, axis);
        begin[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(at);
    }
    return begin;
}

void expect_covered(const BlockPlaces& places, std::span<const Grid> blocks,
                    const std::string& first_name) {
    std::uint64_t given = 0, covered = 0;
    for (const Grid& block : blocks)
        given += block.vertex_count();
    const std::uint64_t all = places.whole.vertex_count();
    if (given >= all) {
        std::vector<bool> seen(all);
        for (std::size_t i = 0; i < blocks.size(); ++i)
            each_row_of_block(places.begins[i], blocks[i].vertices, places.whole.vertices,
                              [&](std::uint64_t to, std::uint64_t) {
                                  for (std::uint64_t at = to; at < to + blocks[i].vertices[0]; ++at)
                                      if (!seen[at]) {
                                          seen[at] = true;
                                          ++covered;
                                      }
                              });
    }
    if (covered != all)
        throw Error("{} and {} other parts: leave vertices of {} x {} x {} without values",
                    first_name, blocks.size() - 1, places.whole.vertices[0],
                    places.whole.vertices[1], places.whole.vertices[2]);
}

} // namespace

BlockPlaces places_of_blocks(std::span<const Grid> blocks, std::span<const std::string> names) {
    BlockPlaces places{.whole = blocks.front(), .begins = {}};
    std::vector<Begin> begins;
    std::map<Begin, std::size_t> taken;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        begins.push_back(way_to(blocks[i], names[i], blocks.front(), names.front()));
        if (const auto [other, is_new] = taken.insert({begins.back(), i}); !is_new)
            throw Error("{}: begins where {} begins, expected parts beside each other", names[i],
                        names[other->second]);
    }
    Begin low = begins.front(), sizes{};
    places.begins.resize(blocks.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::int64_t end = begins.front()[axis];
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            low[axis] = std::min(low[axis], begins[i][axis]);
            end = std::max(end, begins[i][axis] + std::int64_t{blocks[i].vertices[axis]});
        }
        sizes[axis] = end - low[axis];
        const int i = static_cast<int>(axis);
        places.whole.origin +=
            places.whole.direction[i] * places.whole.spacing[i] * static_cast<double>(low[axis]);
        for (std::size_t block = 0; block < blocks.size(); ++block)
            places.begins[block][axis] =
                static_cast<std::uint32_t>(begins[block][axis] - low[axis]);
    }
    places.whole.vertices = checked_vertices(sizes, names.front());
    expect_covered(places, blocks, names.front());
    return places;
}

} // namespace isochron::index
