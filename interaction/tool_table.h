// Every tool there is, a row each.
#pragma once

#include "interaction/tool.h"

#include <array>
#include <memory>
#include <string_view>

namespace isochron::interaction {

struct ToolRow {
    ToolKind kind;
    std::string_view words;  ///< what it is called on the panel
    std::string_view effect; ///< what a hand and what the mouse does with it
    /// It asks what its ray meets among what is shown: what it finds depends on more than devices.
    bool looks_at_surfaces;
    std::unique_ptr<Tool> (*make)();
    /// What is drawn for it, also while no hand holds it; null: nothing.
    ToolDrawing (*draw)(const ToolState& state, const DataFrame& data);
};

/// In the order of `ToolKind`.
const std::array<ToolRow, kNames<ToolKind>.size()>& tool_table();

/// Of all tools.
ToolDrawing drawing_of(const ToolState& state, const DataFrame& data);

} // namespace isochron::interaction
