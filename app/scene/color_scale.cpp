// The color scale of the surfaces.
#include "app/scene/color_scale.h"

#include <fmt/format.h>

namespace isochron::app {
namespace {

std::string with_brackets(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

} // namespace

std::optional<ColorScale> color_scale(const ExplorerState& state, const index::IndexFile& file) {
    ColorScale scale;
    switch (state.coloring.by) {
    case interaction::ColorBy::surface: return std::nullopt;
    case interaction::ColorBy::value: {
        const index::ColorArray* color = file.color();
        if (!color)
            return std::nullopt;
        scale.title = with_brackets(color->array, color->value_unit);
        scale.whole = {color->low, color->high};
        break;
    }
    case interaction::ColorBy::first_crossing:
        scale.title = with_brackets("first crossing", file.info().time_unit);
        scale.whole = {file.info().times.front(), file.info().times.back()};
        break;
    }
    scale.range = state.coloring.range.value_or(scale.whole);
    scale.map = *render::color_map_from_name(state.coloring.map);
    return scale;
}

} // namespace isochron::app
