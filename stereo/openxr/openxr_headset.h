// A headset through OpenXR: connected, lost, and connected again.
#pragma once

#include "stereo/headset.h"
#include "stereo/openxr/openxr_options.h"

#include <memory>

namespace isochron::stereo {

/// Connects to the runtime at once, or later if the options wait for one; to the headset when it is
/// attached to a context.
/// @throws render::Error when there is no runtime, or it does not fit the options
std::unique_ptr<Headset> open_headset(const OpenXrOptions& options);

} // namespace isochron::stereo
