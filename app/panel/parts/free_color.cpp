// Colors for new surfaces.
#include "app/panel/parts/free_color.h"

#include "render/passes/color_map.h"

#include <algorithm>

namespace isochron::app {

glm::vec3 free_color(const std::vector<interaction::Isosurface>& surfaces) {
    const auto& palette = render::surface_palette();
    const auto free = std::ranges::find_if(palette, [&](const glm::vec3& color) {
        return std::ranges::find(surfaces, color, &interaction::Isosurface::color) ==
               surfaces.end();
    });
    return free == palette.end() ? palette.front() : *free;
}

} // namespace isochron::app
