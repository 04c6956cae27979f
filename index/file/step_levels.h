// The levels of a step's bricks as bytes of the file.
//
// Behind the tables of a step, where the index has bricks and its type more than 8 bits: XXH3 of
// the rest (u64), 1 where each value of the step has its own level and 0 else (u64), then the
// ordinals of the values or of the thresholds between them (u64 each).
#pragma once

#include "index/volume/level_map.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

/// Whether steps of this type have levels of their own: those of 8-bit types are all alike.
inline bool has_step_levels(ValueType type) {
    return size_of(type) > 1;
}

std::vector<std::byte> bytes_of(const LevelMap& levels);

/// @return nothing where the bytes are damaged
std::optional<LevelMap> step_levels(ValueType type, std::span<const std::byte> bytes);

} // namespace isochron::index
