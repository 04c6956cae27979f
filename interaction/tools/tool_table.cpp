// The table of all tools.
#include "interaction/tools/tool_table.h"

#include "interaction/tools/clip_tool.h"
#include "interaction/tools/grab_tool.h"
#include "interaction/tools/pick_tool.h"
#include "interaction/tools/ruler_tool.h"
#include "interaction/tools/slice_tool.h"

namespace isochron::interaction {
namespace {

template <class T>
std::unique_ptr<Tool> made() {
    return std::make_unique<T>();
}

} // namespace

const std::array<ToolRow, kNames<ToolKind>.size()>& tool_table() {
    static const std::array<ToolRow, kNames<ToolKind>.size()> rows{{
        {.kind = ToolKind::grab,
         .words = "grab",
         .effect = "a hand holds the volume; the mouse turns it",
         .icon = "M 12 3 L 12 21 M 3 12 L 21 12 M 9 6 L 12 3 L 15 6 M 9 18 L 12 21 L 15 18 "
                 "M 6 9 L 3 12 L 6 15 M 18 9 L 21 12 L 18 15",
         .found_as = "grab",
         .key = {},
         .make = made<GrabTool>,
         .remove = [](const Settings&, Commands& commands) { commands.mark = Mark{}; }},
        {.kind = ToolKind::pick,
         .words = "pick",
         .effect = "marks the place on a surface",
         .icon = "M 12 21 L 7 13 L 6 9 L 8 5 L 12 3 L 16 5 L 18 9 L 17 13 Z D 12 9 2.2",
         .found_as = "pick and grab",
         .key = '4',
         .looks_at_surfaces = true,
         .make = made<PickTool>,
         .makes = "mark",
         .made = [](const Settings& settings) { return settings.mark.point.has_value(); },
         .remove = [](const Settings&, Commands& commands) { commands.mark = Mark{}; },
         .rows = mark_rows,
         .old_bit = 49},
        {.kind = ToolKind::clip,
         .words = "clip plane",
         .effect = "cuts the surfaces; hold the plane to move and turn it",
         .icon = "M 4 8 L 13 4 L 20 8 L 20 16 L 11 20 L 4 16 Z M 8 22 L 8 11 L 16 2 L 16 13 Z",
         .found_as = "clip plane",
         .key = '5',
         .looks_at_surfaces = true,
         .make = made<ClipTool>,
         .makes = "clip plane",
         .made =
             [](const Settings& settings) {
                 return settings.clip.shown || settings.clip_box.shown;
             },
         .held = true,
         .remove =
             [](const Settings&, Commands& commands) {
                 commands.clip = ClipPlane{};
                 commands.clip_box = ClipBox{};
             },
         .draw = draw_clip,
         .old_bit = 50},
        {.kind = ToolKind::ruler,
         .words = "ruler",
         .effect = "measures between places on surfaces",
         .icon = "M 2 16 L 16 2 L 22 8 L 8 22 Z M 6 12 L 9 15 M 9 9 L 11 11 M 12 6 L 15 9",
         .found_as = "ruler (measures a length or an angle)",
         .key = '6',
         .looks_at_surfaces = true,
         .make = made<RulerTool>,
         .makes = "ruler",
         .made = [](const Settings& settings) { return !settings.rulers.list.empty(); },
         .remove =
             [](const Settings& settings, Commands& commands) {
                 commands.rulers = without_ruler(settings.rulers, settings.rulers.picked);
             },
         .draw = draw_rulers,
         .rows = ruler_rows,
         .old_bit = 51},
        {.kind = ToolKind::slice,
         .words = "slice",
         .effect = "shows the values on a plane; hold the plane to move and turn it",
         .icon = "M 3 15 L 13 11 L 21 15 L 11 19 Z M 3 15 L 3 8 L 13 4 L 21 8 L 21 15 "
                 "M 7 14 L 12 17 M 11 12 L 17 16",
         .found_as = "slice (values on a plane)",
         .key = KeyStroke('5', Chord::control),
         .looks_at_surfaces = true,
         .make = made<SliceTool>,
         .makes = "slice",
         .made = [](const Settings& settings) { return settings.slices.seen(); },
         .held = true,
         .remove = [](const Settings&, Commands& commands) { commands.slices = Slices{}; },
         .draw = draw_slices},
    }};
    return rows;
}

std::string tool_keys() {
    std::string keys;
    for (const ToolRow& row : tool_table())
        if (row.key)
            keys += (keys.empty() ? "" : " ") + name_of(*row.key);
    return keys;
}

ToolDrawing drawing_of(const Settings& settings, const DataFrame& data) {
    ToolDrawing all;
    for (const ToolRow& row : tool_table()) {
        if (!row.draw)
            continue;
        ToolDrawing drawing = row.draw(settings, data);
        all.lines.insert(all.lines.end(), drawing.lines.begin(), drawing.lines.end());
        all.labels.insert(all.labels.end(), drawing.labels.begin(), drawing.labels.end());
    }
    return all;
}

} // namespace isochron::interaction
