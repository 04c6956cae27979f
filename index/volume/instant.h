// An instant of a series: one of its steps, or a moment between two of them.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

namespace isochron::index {

/// A step k and a fraction n / kFractions of the way to the next step: what a query asks for, and what
/// is shown. Between two steps, values are blended (index/volume/blend.h). Work on values takes an
/// Instant from the query to StepView (index/file/step_view.h), which gives the values. A number alone
/// is no instant, and an instant is no number: whoever takes `step` alone leaves the fraction out.
///
/// Commands have instants, too, so this header includes no other of the project.
struct Instant {
    static constexpr std::uint32_t kFractions = 65536;

    std::uint32_t step = 0;
    std::uint32_t fraction = 0; ///< below kFractions

    constexpr Instant() = default;
    constexpr explicit Instant(std::uint32_t of_step) : step(of_step) {}
    constexpr Instant(std::uint32_t of_step, std::uint32_t n) : step(of_step), fraction(n) {}

    constexpr bool between() const { return fraction != 0; }
    /// In the order of time; in tables of instants.
    constexpr std::uint64_t number() const { return std::uint64_t{step} * kFractions + fraction; }
    /// This instant in a series of so many steps: the last step holds.
    constexpr Instant within(std::size_t steps) const {
        return step + std::size_t{1} < steps ? *this : Instant(step);
    }

    auto operator<=>(const Instant&) const = default; ///< the earlier one is less
};

} // namespace isochron::index
