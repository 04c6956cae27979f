// What is known of the GL driver in use.
#pragma once

#include "render/gl/gl.h"

namespace isochron::render {

/// Whether the processor draws: then every sample and every conversion of a blend counts.
bool draws_in_software(const Gl& gl);

/// The most samples for each pixel that targets can have, at least 1.
int max_samples(const Gl& gl);

} // namespace isochron::render
