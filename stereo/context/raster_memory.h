// Keeps the memory of software GL for the next frame.
#pragma once

namespace isochron::stereo {

/// Lets this process keep up to 64 MiB that it has freed. Mesa's llvmpipe takes a few megabytes for
/// each frame and frees them; given back to Linux at once, all their pages fault again in the next
/// frame, which took up to a quarter of the time of drawing quads.
void keep_raster_memory();

} // namespace isochron::stereo
