// Regions of one level of detail.
#include "index/detail/detail_regions.h"

#include "index/volume/query.h"

#include <algorithm>
#include <numeric>

namespace isochron::index {
namespace {

constexpr std::uint32_t kMostAlong = 16;
constexpr std::uint32_t kSmallestEdge = 2 * kChunkEdge;

} // namespace

DetailRegions::DetailRegions(const Grid& grid) : edge_(kSmallestEdge) {
    const auto cells = grid.cells();
    while (std::ranges::max(cells) > kMostAlong * edge_)
        edge_ *= 2;
    for (std::size_t axis = 0; axis < 3; ++axis)
        counts_[axis] = (cells[axis] + edge_ - 1) / edge_;
}

std::vector<std::uint8_t> DetailRegions::levels(std::span<const std::int8_t> wished,
                                                unsigned coarser, unsigned most) const {
    std::vector<std::uint8_t> levels(size());
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const int wish = i < wished.size() ? wished[i] : 0;
        const int parts = std::max(wish + static_cast<int>(coarser), 0);
        levels[i] = static_cast<std::uint8_t>(
            std::min(parts / DetailQuery::kPartsOfLevel, static_cast<int>(most)));
    }
    return levels;
}

std::vector<std::uint32_t> DetailRegions::from_the_middle() const {
    std::vector<std::uint32_t> numbers(size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    const auto distance = [this](std::uint32_t number) { // squared, doubled
        const auto here = at(number);
        int sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int d = 2 * static_cast<int>(here[axis]) + 1 - static_cast<int>(counts_[axis]);
            sum += d * d;
        }
        return sum;
    };
    std::ranges::stable_sort(numbers, {}, distance);
    return numbers;
}

bool DetailRegions::draws(std::span<const std::uint8_t> levels, unsigned level,
                          const std::array<std::uint32_t, 3>& cell) const {
    std::array<std::uint32_t, 3> own{}, low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        own[axis] = along(axis, cell[axis], level);
        low[axis] = along(axis, cell[axis] - (cell[axis] > 0 ? 1 : 0), level);
        high[axis] = along(axis, cell[axis] + 1, level);
    }
    if (const unsigned here = levels[number(own)]; here >= level)
        return here == level;
    for (std::uint32_t z = low[2]; z <= high[2]; ++z)
        for (std::uint32_t y = low[1]; y <= high[1]; ++y)
            for (std::uint32_t x = low[0]; x <= high[0]; ++x)
                if (levels[number({x, y, z})] == level)
                    return true;
    return false;
}

std::vector<bool> DetailRegions::chunks_of(std::span<const std::uint8_t> levels, unsigned level,
                                           const ChunkGrid& chunks) const {
    std::vector<bool> wanted(chunks.count());
    for (std::size_t i = 0; i < levels.size(); ++i) {
        if (levels[i] != level)
            continue;
        const auto here = at(i);
        std::array<std::uint32_t, 3> first{}, last{};
        for (std::size_t axis = 0; axis < 3; ++axis) { // one cell more on each side
            const std::uint32_t low = here[axis] * edge_ >> level;
            const std::uint32_t high = (here[axis] + 1) * edge_ >> level;
            first[axis] = (low > 0 ? low - 1 : 0) / kChunkEdge;
            last[axis] = std::min(high / kChunkEdge, chunks.counts()[axis] - 1);
        }
        for (std::uint32_t z = first[2]; z <= last[2]; ++z)
            for (std::uint32_t y = first[1]; y <= last[1]; ++y)
                for (std::uint32_t x = first[0]; x <= last[0]; ++x)
                    wanted[std::size_t{z} * chunks.chunks_of_layer() + chunks.place(x, y)] = true;
    }
    return wanted;
}

bool has_mixed_levels(const Grid& grid) {
    // The last cell of a level may reach almost twice as far as the volume.
    return std::ranges::max(grid.vertices) <= 1u << 14;
}

} // namespace isochron::index
