// Half floats, which become f32 exactly.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace isochron::index {

/// IEEE 754 binary16.
inline float from_half(std::uint16_t half) {
    const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000) << 16;
    const std::uint32_t exponent = (half >> 10) & 31, fraction = half & 0x3ff;
    if (exponent == 0) { // too small to be normal: in units of 2^-24
        const float value = static_cast<float>(fraction) * 0x1p-24F;
        return sign ? -value : value;
    }
    const std::uint32_t high = exponent == 31 ? 255 : exponent + 112;
    return std::bit_cast<float>(sign | high << 23 | fraction << 13);
}

/// @param out twice as many bytes as `halves`
inline void widen_halves(std::span<const std::byte> halves, std::span<std::byte> out) {
    for (std::size_t i = 0; 2 * i + 1 < halves.size(); ++i) {
        std::uint16_t half = 0;
        std::memcpy(&half, &halves[2 * i], sizeof half);
        const float value = from_half(half);
        std::memcpy(&out[sizeof value * i], &value, sizeof value);
    }
}

} // namespace isochron::index
