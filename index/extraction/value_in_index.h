// The values at places in an open index.
#pragma once

#include "index/file/index_file.h"
#include "index/volume/instant.h"

#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// What `value_at` returns, for a step of an index. In a large step it reads only the chunks around
/// the place.
/// @throws Error when they cannot be read or are damaged
std::optional<double> value_in(const IndexFile& file, Instant instant, const glm::dvec3& at);

/// `value_in` at each place; NaN where there is none. A chunk is read once.
/// @throws Stopped when it is asked to stop
std::vector<double> values_in(const IndexFile& file, Instant instant,
                              std::span<const glm::dvec3> places, const std::stop_token& stop = {});

} // namespace isochron::index
