// Turns the differences in a packed chunk back into values.
#pragma once

#include "index/volume/value_type.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

/// Replaces differences along some axes by values: running sums along each axis, of unsigned
/// numbers of the type's size, modulo 2^bits.
/// @param values [z][y][x], x fastest, `size` of them along x, y and z
void from_differences(ValueType type, const std::array<std::uint32_t, 3>& size,
                      const std::array<bool, 3>& axes, std::span<std::byte> values);

/// Joins the bytes of values, given as the first bytes of all values, then all second bytes, ...
/// @param size bytes of a value @param out as long as `shuffled`
void unshuffle(std::span<const std::byte> shuffled, std::size_t size, std::byte* out);
/// Unshuffles folded differences: 2 d, or -2 d - 1 where d is negative, become d.
void unshuffle_folded(std::span<const std::byte> shuffled, std::size_t size, std::byte* out);

/// Shifts values of `size` bytes left.
void shift_up(std::span<std::byte> values, std::size_t size, unsigned bits);

} // namespace isochron::index
