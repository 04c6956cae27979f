// T-BON: an octree per step over one topology.
#include "tests/bench/rivals/tbon.h"

#include "index/system/parallel.h"
#include "index/volume/ordinal.h"
#include "index/volume/stored_cut.h"

#include <algorithm>
#include <array>
#include <limits>

namespace isochron::bench {

using index::CellId;

Tbon::Tbon(const index::StepValues& values, unsigned threads) : values_(values) {
    build_topology();
    extremes_.resize(values.steps * nodes_.size() * 2 * size_of(values.type));
    index::parallel_for(
        values.steps, index::thread_count(threads),
        [&](std::size_t step, unsigned) {
            index::visit_value_type(
                values_.type, [&]<class T>(std::type_identity<T>) { find_extremes<T>(step); });
        },
        nullptr);
}

std::uint64_t Tbon::bytes() const {
    return nodes_.size() * sizeof(Node) + extremes_.size();
}

void Tbon::build_topology() {
    // Number of nodes of each level along the axes; the leaves' level first.
    std::vector<std::array<std::uint32_t, 3>> levels{values_.grid.cells()};
    do {
        auto extent = levels.back();
        for (std::uint32_t& along : extent)
            along = (along + 1) / 2;
        levels.push_back(extent);
    } while (levels.back() != std::array<std::uint32_t, 3>{1, 1, 1});
    levels.erase(levels.begin()); // the cells themselves

    nodes_ = {{.first_child = 0, .children = 0, .x = 0, .y = 0, .z = 0}};
    std::size_t parent = 0;
    for (std::size_t level = levels.size() - 1; level-- > 0;) {
        const auto& extent = levels[level];
        for (const std::size_t end = nodes_.size(); parent < end; ++parent) {
            const Node above = nodes_[parent];
            const auto first = static_cast<std::uint32_t>(nodes_.size());
            for (std::uint32_t z = 2 * above.z; z < std::min(2 * above.z + 2, extent[2]); ++z)
                for (std::uint32_t y = 2 * above.y; y < std::min(2 * above.y + 2, extent[1]); ++y)
                    for (std::uint32_t x = 2 * above.x; x < std::min(2 * above.x + 2, extent[0]);
                         ++x)
                        nodes_.push_back({0, 0, x, y, z});
            nodes_[parent].first_child = first;
            nodes_[parent].children = static_cast<std::uint32_t>(nodes_.size()) - first;
        }
    }
}

template <class T>
void Tbon::find_extremes(std::size_t step) {
    const auto [nx, ny, nz] = values_.grid.vertices;
    const T* volume = values_.step<T>(step).data();
    auto* extremes = reinterpret_cast<Extremes<T>*>(extremes_.data()) + step * nodes_.size();
    for (std::size_t number = nodes_.size(); number-- > 0;) {
        const Node& node = nodes_[number];
        Extremes<T> all{std::numeric_limits<T>::max(), std::numeric_limits<T>::lowest()};
        if constexpr (std::is_floating_point_v<T>)
            all = {std::numeric_limits<T>::infinity(), -std::numeric_limits<T>::infinity()};
        for (std::uint32_t i = 0; i < node.children; ++i) {
            const Extremes<T>& child = extremes[node.first_child + i];
            all = {std::min(all.low, child.low), std::max(all.high, child.high)};
        }
        if (node.children == 0)
            for (std::uint32_t z = 2 * node.z; z < std::min(2 * node.z + 3, nz); ++z)
                for (std::uint32_t y = 2 * node.y; y < std::min(2 * node.y + 3, ny); ++y) {
                    const T* row = volume + (std::size_t{z} * ny + y) * nx;
                    // In this order a comparison with NaN does not change the extremes.
                    for (std::uint32_t x = 2 * node.x; x < std::min(2 * node.x + 3, nx); ++x)
                        all = {row[x] < all.low ? row[x] : all.low,
                               row[x] > all.high ? row[x] : all.high};
                }
        extremes[number] = all;
    }
}

void Tbon::search(const index::Query& query, std::vector<CellId>& out) const {
    const auto cut = index::stored_cut(values_.type, values_.scaling, query.isovalue);
    if (!cut)
        return;
    index::visit_value_type(values_.type, [&]<class T>(std::type_identity<T>) {
        search_step<T>(query.instant.step,
                       index::from_ordinal<T>(static_cast<index::Ordinal<T>>(*cut)), out);
    });
}

template <class T>
void Tbon::search_step(std::size_t step, T cut, std::vector<CellId>& out) const {
    const T* volume = values_.step<T>(step).data();
    const auto* extremes =
        reinterpret_cast<const Extremes<T>*>(extremes_.data()) + step * nodes_.size();
    const auto visit = [&](const auto& self, std::uint32_t number) -> void {
        if (!(extremes[number].low < cut && cut <= extremes[number].high))
            return;
        const Node& node = nodes_[number];
        if (node.children == 0)
            search_leaf(volume, cut, node, out);
        for (std::uint32_t i = 0; i < node.children; ++i)
            self(self, node.first_child + i);
    };
    visit(visit, 0);
}

/// Uses three bits for each of the nine rows of vertices around the eight cells.
template <class T>
void Tbon::search_leaf(const T* volume, T cut, const Node& leaf, std::vector<CellId>& out) const {
    const auto [nx, ny, nz] = values_.grid.vertices;
    const std::uint32_t x = 2 * leaf.x, y = 2 * leaf.y, z = 2 * leaf.z;
    const std::uint32_t width = std::min(3u, nx - x), height = std::min(3u, ny - y),
                        depth = std::min(3u, nz - z);
    std::array<std::array<unsigned, 3>, 3> upper{}, nan{};
    for (std::uint32_t k = 0; k < depth; ++k)
        for (std::uint32_t j = 0; j < height; ++j) {
            const T* row = volume + (std::size_t{z + k} * ny + y + j) * nx + x;
            for (std::uint32_t i = 0; i < width; ++i) {
                upper[k][j] |= static_cast<unsigned>(row[i] >= cut) << i;
                nan[k][j] |= static_cast<unsigned>(row[i] != row[i]) << i;
            }
        }
    const auto [cells_x, cells_y, cells_z] = values_.grid.cells();
    const unsigned inside = (1u << (width - 1)) - 1;
    for (std::uint32_t k = 0; k + 1 < depth; ++k)
        for (std::uint32_t j = 0; j + 1 < height; ++j) {
            const unsigned any =
                upper[k][j] | upper[k][j + 1] | upper[k + 1][j] | upper[k + 1][j + 1];
            const unsigned all =
                upper[k][j] & upper[k][j + 1] & upper[k + 1][j] & upper[k + 1][j + 1];
            const unsigned no = nan[k][j] | nan[k][j + 1] | nan[k + 1][j] | nan[k + 1][j + 1];
            const unsigned active = (any | any >> 1) & ~(all & all >> 1) & ~(no | no >> 1) & inside;
            const CellId first = ((z + k) * cells_y + y + j) * cells_x + x;
            if (active & 1)
                out.push_back(first);
            if (active & 2)
                out.push_back(first + 1);
        }
}

} // namespace isochron::bench
