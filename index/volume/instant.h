// A moment of a series: today one of its steps.
#pragma once

#include <concepts>
#include <cstdint>
#include <utility>

namespace isochron::index {

/// The moment whose cells a query asks for. Work on values takes an Instant from the query to
/// the places where the values of chunks are copied (`ChunkCube::copy`, `StepSlab::copy`), through
/// StepView (index/file/step_view.h). A moment between two steps needs a fraction here, and a blend
/// of two steps' values there.
struct Instant {
    std::uint32_t step = 0;

    constexpr Instant() = default;
    constexpr Instant(std::uint32_t of_step) : step(of_step) {}
    /// The last step at or before the moment: the row of this moment in tables with a row a step.
    constexpr operator std::uint32_t() const { return step; }

    friend constexpr bool operator==(const Instant&, const Instant&) = default;
    template <std::integral Number>
    friend constexpr bool operator==(const Instant& at, Number number) {
        return std::cmp_equal(at.step, number);
    }
};

} // namespace isochron::index
