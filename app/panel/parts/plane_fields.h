// A plane in numbers: where it lies along its normal, and the normal itself.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/setting_values.h"

namespace isochron::app {

/// A line in the current window, or two where it has no room. @param right end of the room, screen
/// pixels @param normal tip of the normal's fields
void plane_fields(const PanelModel& model, interaction::Plane& plane, float right,
                  const char* normal);

} // namespace isochron::app
