// The levels of a step's bricks as bytes of the file.
//
// They follow the tables of a step if the index has bricks and its type has more than 8 bits: XXH3
// of the rest (u64); 1 if each value of the step has its own level, else 2, in version 3 0 (u64);
// then the ordinals of these values, or else, of version 4, of the lowest and the highest value, and
// of the thresholds (u64 each).
#pragma once

#include "index/volume/level_map.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

/// Whether each step of this type has its own levels: for 8-bit types they are always the same.
inline bool has_step_levels(ValueType type) {
    return size_of(type) > 1;
}

std::vector<std::byte> bytes_of(const LevelMap& levels);

/// @return nothing if the bytes are damaged
std::optional<LevelMap> step_levels(ValueType type, std::span<const std::byte> bytes);

} // namespace isochron::index
