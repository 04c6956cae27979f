// A headset through OpenXR: connected, lost, and connected again.
#pragma once

#include "stereo/headset.h"
#include "stereo/openxr/openxr_options.h"

#include <memory>

namespace isochron::stereo {

/// The runtime is connected to at once, or later where the options wait for one; the headset once it
/// is attached to a context.
/// @throws render::Error when there is no runtime, or none that suits the options
std::unique_ptr<Headset> open_headset(const OpenXrOptions& options);

} // namespace isochron::stereo
