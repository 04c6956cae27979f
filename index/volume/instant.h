// A moment of a series: one of its steps, or a moment between two of them.
#pragma once

#include <concepts>
#include <cstdint>
#include <utility>

namespace isochron::index {

/// The moment whose cells a query asks for: a step k and a fraction n / kFractions of the way to the
/// next step. Between two steps, values are blended (index/volume/blend.h). Work on values takes an
/// Instant from the query to StepView (index/file/step_view.h), which gives the values.
struct Instant {
    static constexpr std::uint32_t kFractions = 65536;

    std::uint32_t step = 0;
    std::uint32_t fraction = 0; ///< below kFractions

    constexpr Instant() = default;
    constexpr Instant(std::uint32_t of_step, std::uint32_t n = 0) : step(of_step), fraction(n) {}
    /// The last step at or before the moment: the row of this moment in tables with a row a step.
    constexpr operator std::uint32_t() const { return step; }

    constexpr bool between() const { return fraction != 0; }
    /// In the order of time; in tables of moments.
    constexpr std::uint64_t number() const { return std::uint64_t{step} * kFractions + fraction; }
    /// This moment in a series of so many steps: the last step holds.
    constexpr Instant within(std::size_t steps) const {
        return step + std::size_t{1} < steps ? *this : Instant(step);
    }

    friend constexpr bool operator==(const Instant&, const Instant&) = default;
    template <std::integral Number>
    friend constexpr bool operator==(const Instant& at, Number number) {
        return at.fraction == 0 && std::cmp_equal(at.step, number);
    }
};

} // namespace isochron::index
