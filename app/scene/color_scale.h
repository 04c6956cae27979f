// The color scale: which values the colors on the surfaces stand for.
#pragma once

#include "app/frame/explorer_state.h"
#include "render/passes/color_map.h"

#include <array>
#include <optional>
#include <string>

namespace isochron::app {

/// Values and their colors.
struct ColorScale {
    std::string title;             ///< `temperature [K]`
    std::array<double, 2> range{}; ///< values at the ends of the map
    std::array<double, 2> whole{}; ///< range of all values, at cells' color coordinates 0 and 1
    render::ColorMap map{};
    bool operator==(const ColorScale&) const = default;
};

/// Empty if colors tell surfaces apart, or the index has no second array to color by.
std::optional<ColorScale> color_scale(const ExplorerState& state, const index::IndexFile& file);

} // namespace isochron::app
