// The table of all tools.
#include "interaction/tools/tool_table.h"

#include "interaction/tools/clip_tool.h"
#include "interaction/tools/grab_tool.h"
#include "interaction/tools/pick_tool.h"
#include "interaction/tools/ruler_tool.h"

namespace isochron::interaction {
namespace {

template <class T>
std::unique_ptr<Tool> made() {
    return std::make_unique<T>();
}

} // namespace

const std::array<ToolRow, kNames<ToolKind>.size()>& tool_table() {
    static const std::array<ToolRow, kNames<ToolKind>.size()> rows{{
        {ToolKind::grab, "grab", "a hand holds the volume; the mouse turns it", false,
         made<GrabTool>, nullptr},
        {ToolKind::pick, "pick", "marks the place on a surface", true, made<PickTool>, nullptr},
        {ToolKind::clip, "clip plane", "cuts the surfaces; hold the plane to move and turn it",
         true, made<ClipTool>, draw_clip},
        {ToolKind::ruler, "ruler", "measures between two places on surfaces", true, made<RulerTool>,
         draw_ruler},
    }};
    return rows;
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
