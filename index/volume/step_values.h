// Read-only view of the steps of a series in memory, on which search and extraction work.
#pragma once

#include "index/volume/grid.h"
#include "index/volume/value_type.h"

#include <cstddef>
#include <span>

namespace isochron::index {

/// Stored values of all steps, or of a window of them, with a constant stride from step to step.
/// Does not own the memory; cheap to copy.
struct StepValues {
    Grid grid;
    ValueType type = ValueType::f32;
    Scaling scaling;
    std::size_t steps = 0;            ///< steps of the series
    const std::byte* first = nullptr; ///< step `first_step`, aligned for the type
    std::size_t stride = 0;           ///< bytes from one step to the next, a multiple of 8
    std::size_t first_step = 0;       ///< first step of the window; do not ask for steps outside

    /// Stored values of one step, [z][y][x], x fastest.
    template <class T>
    std::span<const T> step(std::size_t t) const {
        return {reinterpret_cast<const T*>(first + (t - first_step) * stride), grid.vertex_count()};
    }
    /// The values of a step as bytes.
    std::span<const std::byte> step_bytes(std::size_t t) const {
        return {first + (t - first_step) * stride, grid.vertex_count() * size_of(type)};
    }
};

} // namespace isochron::index
