// What is known of the GL driver in use.
#pragma once

#include "render/gl/gl.h"

namespace isochron::render {

/// Whether the processor draws: then every sample and every conversion of a blend counts.
bool draws_in_software(const Gl& gl);

/// Whether cells take the processor's ways: it computes their normals, sends them whole, leaves out
/// what is hidden, and draws footprints eye by eye. By `gl.drawn_by`, or else the environment's
/// ISOCHRON_DRAWN_BY (`gpu` or `processor`, for tests), or else as the driver draws.
bool takes_processor_ways(const Gl& gl);

/// Asked once a frame. @throws Error when the context is lost, as after a reset of the GPU, where
/// the driver tells
void expect_context(const Gl& gl);

/// The most samples for each pixel that targets can have, at least 1.
int max_samples(const Gl& gl);

} // namespace isochron::render
