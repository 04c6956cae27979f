// The table of all tools, one row each.
#pragma once

#include "interaction/input/actions.h"
#include "interaction/tools/tool.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::interaction {

struct ToolRow {
    ToolKind kind;
    std::string_view words;  ///< its name on the panel
    std::string_view effect; ///< what a hand, and what the mouse does with it
    std::string_view icon;   ///< its lines, as app/panel/parts/icons.h describes them
    /// In the search of commands; the help of keys leaves out what stands in brackets.
    std::string_view found_as;
    std::optional<KeyStroke> key; ///< chooses it
    /// It asks which surface its ray meets, so its commands depend on more than devices.
    bool looks_at_surfaces = false;
    std::unique_ptr<Tool> (*make)();

    // What the tool leaves in the data; null where it does nothing of the kind.
    std::string_view makes = {};             ///< what that is called: `ruler`
    bool (*made)(const Settings&) = nullptr; ///< whether it is there
    bool held = false;                       ///< hands hold that, and move it
    /// What Delete does while the mouse holds the tool.
    void (*remove)(const Settings& settings, Commands& commands);
    /// Also while no hand holds the tool.
    ToolDrawing (*draw)(const Settings& settings, const DataFrame& data) = nullptr;
    /// The rows of what these commands have made. @param before the settings that they changed
    std::vector<MarkedRow> (*rows)(const Commands&, const Settings& before) = nullptr;

    int old_bit = kNoOldBit; ///< bit of the action that chooses it, in recordings of version 1
};

/// In the order of `ToolKind`.
const std::array<ToolRow, kNames<ToolKind>.size()>& tool_table();
inline const ToolRow& tool_row(ToolKind kind) {
    return tool_table()[static_cast<std::size_t>(kind)];
}

/// The keys that choose tools, for people: `4 5 6`.
std::string tool_keys();

/// The drawings of all tools together.
ToolDrawing drawing_of(const Settings& settings, const DataFrame& data);

} // namespace isochron::interaction
