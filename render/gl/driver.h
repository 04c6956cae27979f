// Properties of the GL driver in use.
#pragma once

#include "render/gl/gl.h"

namespace isochron::render {

/// Whether the driver draws on the processor: then samples and color conversions are expensive.
bool draws_in_software(const Gl& gl);

/// Whether cells are drawn as suits a processor: it computes their normals, sends sets whole, culls
/// hidden cells, and draws footprints one eye at a time. Decided by `gl.drawn_by`, else by the
/// environment variable ISOCHRON_DRAWN_BY (`gpu` or `processor`, for tests), else by the driver.
bool is_drawn_for_processor(const Gl& gl);

/// Call once a frame. @throws Error when the context is lost, for example after a reset of the GPU,
/// if the driver tells
void expect_context(const Gl& gl);

/// Most samples per pixel that a target can have, at least 1.
int max_samples(const Gl& gl);

} // namespace isochron::render
