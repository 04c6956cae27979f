// The value at a place in an open index.
#pragma once

#include "index/file/index_file.h"
#include "index/volume/instant.h"

#include <glm/vec3.hpp>

#include <optional>

namespace isochron::index {

/// What `value_at` returns, for a step of an index. In a large step it reads only the chunks around
/// the place.
/// @throws Error when they cannot be read or are damaged
std::optional<double> value_in(const IndexFile& file, Instant instant, const glm::dvec3& at);

} // namespace isochron::index
