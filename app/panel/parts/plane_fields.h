// A plane in numbers: where it lies along its normal, and the normal itself.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/setting_values.h"

namespace isochron::app {

/// A line in the current window, or two where they do not fit into one.
/// @param end of the line, as ImGui::GetCursorPosX counts @param normal tip of the normal's fields
void plane_fields(const PanelModel& model, interaction::Plane& plane, float end,
                  const char* normal);

} // namespace isochron::app
