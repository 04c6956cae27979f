// The value at a place of an open index.
#pragma once

#include "index/file/index_file.h"

#include <glm/vec3.hpp>

#include <optional>

namespace isochron::index {

/// As `value_at`. Of a large step it reads the chunks around the place alone.
/// @throws Error when they cannot be read or are damaged
std::optional<double> value_in(const IndexFile& file, std::uint32_t step, const glm::dvec3& at);

} // namespace isochron::index
