// The panel in the room as the eyes see it.
#pragma once

#include "render/passes/panel_pass.h"

#include <cstddef>
#include <optional>

namespace isochron::app {

struct ShownPanel {
    render::PanelQuad quad;
    std::size_t digest = 0;   ///< of what the texture holds
    std::optional<float> ray; ///< [m] where the wand's ray ends on it
    bool operator==(const ShownPanel&) const = default;
};

} // namespace isochron::app
