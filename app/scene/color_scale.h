// The color scale: which values the colors on the surfaces stand for.
#pragma once

#include "app/frame/explorer_state.h"
#include "index/extraction/extraction.h"
#include "index/extraction/instant_surfaces.h"
#include "render/cells/cell_appearance.h"
#include "render/passes/color_map.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Values and their colors.
struct ColorScale {
    std::string title;                 ///< `temperature [K]`
    std::array<double, 2> range{};     ///< values at the ends of the map
    std::array<double, 2> whole{};     ///< the range that cells' color coordinates span
    std::string map = "viridis";       ///< by its name, unless it has colors of its own:
    std::vector<std::uint32_t> colors; ///< as interaction::Coloring
    render::ColorMapUse use;
    std::string dates_of = {}; ///< unit of values that are times with dates, else empty
    bool logarithmic = false;  ///< both ends of the range are above 0 then
    bool operator==(const ColorScale&) const = default;
};

/// The map's colors from the low to the high end, linear light.
std::vector<glm::vec3> colors_of(const ColorScale& scale);
/// Where a value lies between the ends of the range, 0 to 1 within it.
double share_on(const ColorScale& scale, double value);
/// Where a round number, or a date, stands on a scale.
struct ScaleTick {
    double share; ///< as `share_on` has it
    std::string words;
};
/// @param most of them
std::vector<ScaleTick> ticks_on(const ColorScale& scale, int most);

/// How a pass colors values. @param map of these colors, in linear light
render::ValueColors value_colors(const ColorScale& scale, const render::Texture& map);

/// What has the colors of a scale; constant.
struct ColoredSurfaces {
    index::ExtractionPtr cells; ///< null: none
    std::vector<index::InstantSurfacesPtr> further{};
};

/// The quantiles of the shown values, those of cells and of vertices of further surfaces, at two shares,
/// as a range for a map.
/// @param shares 0 to 1, ascending
/// @return empty if there are no values, or both quantiles are equal
std::optional<std::array<double, 2>> range_of_shares(const ColoredSurfaces& shown,
                                                     const std::array<double, 2>& whole,
                                                     const std::array<double, 2>& shares);

/// Caches `range_of_shares` of the last set: values are sorted only when something changes.
class PercentileRange {
  public:
    /// @param percentiles 0 to 100, ascending
    std::optional<std::array<double, 2>> of(const ColoredSurfaces& shown,
                                            const std::array<double, 2>& whole,
                                            const std::array<double, 2>& percentiles);

  private:
    std::vector<std::weak_ptr<const void>> shown_; ///< keeps nothing that is shown no longer
    std::array<double, 2> whole_{}, percentiles_{};
    std::optional<std::array<double, 2>> range_;
};

/// Number, for ColorSource, of the array whose values are the colors. @param file any of its arrays
std::size_t color_array(const ExplorerState& state, const index::IndexFile& file);

/// Empty when colors tell surfaces apart, or when there is no array to color by.
/// @param shown surfaces whose percentiles are the range, if the state says so
std::optional<ColorScale> color_scale(const ExplorerState& state, const index::IndexFile& file,
                                      const ColoredSurfaces& shown, PercentileRange& cached);

/// Number of the array that is sliced, as `index::IndexFile::array` takes it.
std::size_t slice_array(const ExplorerState& state, const index::IndexFile& file);

/// The scale of slices through an array. @param number of the array
ColorScale slice_scale(const ExplorerState& state, const index::IndexFile& file,
                       std::size_t number);

} // namespace isochron::app
