// The panel in the room as the eyes see it.
#pragma once

#include "render/passes/panel_pass.h"

#include <cstddef>
#include <optional>

namespace isochron::app {

struct ShownPanel {
    render::PanelQuad quad;
    std::size_t digest = 0;   ///< hash of the texture's contents
    std::optional<float> ray; ///< [m] length of the wand's ray if it ends on the panel
    bool operator==(const ShownPanel&) const = default;
};

} // namespace isochron::app
