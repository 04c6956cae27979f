// The lowest and the highest of stored values.
#pragma once

#include "index/volume/level_map.h"
#include "index/volume/value_type.h"

#include <cstddef>
#include <optional>
#include <span>

namespace isochron::index {

/// Takes stored values into account; NaN is neither. Stays empty while there is no other value.
void add_extremes(ValueType type, std::span<const std::byte> stored,
                  std::optional<LevelMap::Extremes>& extremes);

} // namespace isochron::index
