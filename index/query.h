// What is asked of an index: one isovalue at one step.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace isochron::index {

/// How the active cells are found.
enum class SearchMethod : std::uint8_t { cells, bricks, tree, scan };
constexpr std::array<std::string_view, 4> kSearchMethodNames{"cells", "bricks", "tree", "scan"};

/// Active cells are those with min < isovalue <= max over their 8 scaled vertex values, none of
/// them NaN. An isovalue that is NaN or infinite has no active cells.
struct Query {
    std::uint32_t step = 0;
    double isovalue = 0.0;
    bool operator==(const Query&) const = default;
};

} // namespace isochron::index
