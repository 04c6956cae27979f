// Joins small cells to larger ones.
#include "index/detail/cell_joiner.h"

#include "index/detail/detail_regions.h"
#include "index/file/chunks/chunk_store.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::size_t kCellsAtATime = 1 << 16; ///< cells between two looks at the stop token

/// A cell of a level as one number: its z, y and x.
constexpr unsigned kBitsOfPlace = 16;
constexpr std::uint64_t kPlace = (1u << kBitsOfPlace) - 1;
/// The bits that remain of such a number where each coordinate is halved.
constexpr std::uint64_t kHalved = (kPlace >> 1) * (1 | (std::uint64_t{1} << kBitsOfPlace) |
                                                   (std::uint64_t{1} << 2 * kBitsOfPlace));

/// The cell of a level around a smaller one: the doubled center of the smaller cell lies within the
/// doubled ends of the larger.
std::uint64_t parent_of(const CellPoint& point, unsigned level) {
    std::uint64_t cell = 0;
    for (const std::uint32_t at : {point.z, point.y, point.x})
        cell = cell << kBitsOfPlace | at >> (level + 1);
    return cell;
}

/// Sorts cells that are in order of z in little time, and any others.
void sort_cells(std::vector<std::uint64_t>& cells, const std::stop_token& stop) {
    for (auto first = cells.begin(); first != cells.end();) {
        stop_if_asked(stop);
        const auto last = std::find_if(first, cells.end(), [&](std::uint64_t cell) {
            return cell >> 2 * kBitsOfPlace != *first >> 2 * kBitsOfPlace;
        });
        std::sort(first, last);
        first = last;
    }
    if (!std::ranges::is_sorted(cells))
        std::ranges::sort(cells);
    cells.erase(std::ranges::unique(cells).begin(), cells.end());
}

/// Calls back for each point that is smaller than the cells of a level, with the point's number and
/// its parent's number among all parents.
template <class Callback>
void for_each_small(const std::vector<CellPoint>& points, unsigned level,
                    const std::vector<std::uint64_t>& parents, const std::stop_token& stop,
                    Callback&& small) {
    auto at = parents.begin(); // cells beside each other have the same parent, or near ones
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % kCellsAtATime == 0)
            stop_if_asked(stop);
        if (level_of_center(points[i].x) >= level)
            continue;
        const std::uint64_t parent = parent_of(points[i], level);
        if (*at != parent)
            at = std::ranges::lower_bound(parents, parent);
        small(i, static_cast<std::size_t>(at - parents.begin()));
    }
}

} // namespace

CellJoiner::CellJoiner(JoinedCells cells, std::stop_token stop)
    : cells_(std::move(cells)), stop_(std::move(stop)), large_(cells_.points.size()) {
    for (const CellPoint& point : cells_.points)
        levels_ |= 1u << level_of_center(point.x);
}

void CellJoiner::rise() {
    for (std::uint64_t& cell : parents_)
        cell = cell >> 1 & kHalved;
    const unsigned before = level_++;
    if (levels_ >> before & 1)
        for (std::size_t i = 0; i < cells_.points.size(); ++i) {
            if (i % kCellsAtATime == 0)
                stop_if_asked(stop_);
            if (level_of_center(cells_.points[i].x) != before)
                continue;
            --large_;
            const std::uint64_t parent = parent_of(cells_.points[i], level_);
            if (parents_.empty() || parents_.back() != parent)
                parents_.push_back(parent);
        }
    sort_cells(parents_, stop_);
}

JoinedCells CellJoiner::join() const {
    JoinedCells made;
    for (std::size_t i = 0; i < cells_.points.size(); ++i)
        if (level_of_center(cells_.points[i].x) >= level_) {
            made.points.push_back(cells_.points[i]);
            made.colors.push_back(cells_.colors[i]);
        }
    struct Sum {
        glm::dvec3 normals{0.0};
        std::uint32_t size = 0, to_middle = 0;
        std::uint16_t color = 0;
    };
    std::vector<Sum> sums(parents_.size());
    for_each_small(cells_.points, level_, parents_, stop_, [&](std::size_t i, std::size_t parent) {
        sums[parent].normals += unpack_plane(cells_.points[i].plane).normal;
        ++sums[parent].size;
    });
    for (Sum& sum : sums)
        sum.to_middle = sum.size / 2;
    for_each_small(cells_.points, level_, parents_, stop_, [&](std::size_t i, std::size_t parent) {
        if (sums[parent].to_middle-- == 0)
            sums[parent].color = cells_.colors[i];
    });
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double length = glm::length(sums[i].normals);
        const bool one_sided = length >= 0.5 * sums[i].size;
        const auto middle = [&](unsigned axis) {
            return static_cast<std::uint16_t>(doubled_center(
                static_cast<std::uint32_t>(parents_[i] >> axis * kBitsOfPlace & kPlace), level_));
        };
        made.points.push_back({middle(0), middle(1), middle(2), 0,
                               one_sided ? pack({sums[i].normals / length, 0.0}) : 0});
        made.colors.push_back(sums[i].color);
    }
    return made;
}

} // namespace isochron::index
