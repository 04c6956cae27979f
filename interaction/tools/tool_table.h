// The table of all tools, one row each.
#pragma once

#include "interaction/tools/tool.h"

#include <array>
#include <memory>
#include <string_view>

namespace isochron::interaction {

struct ToolRow {
    ToolKind kind;
    std::string_view words;  ///< its name on the panel
    std::string_view effect; ///< what a hand, and what the mouse does with it
    /// It asks which surface its ray meets, so its commands depend on more than devices.
    bool looks_at_surfaces;
    std::unique_ptr<Tool> (*make)();
    /// The drawing for it, also while no hand holds it; null: none.
    ToolDrawing (*draw)(const Settings& settings, const DataFrame& data);
};

/// In the order of `ToolKind`.
const std::array<ToolRow, kNames<ToolKind>.size()>& tool_table();

/// The drawings of all tools together.
ToolDrawing drawing_of(const Settings& settings, const DataFrame& data);

} // namespace isochron::interaction
