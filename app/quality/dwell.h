// A choice that changes at most twice a second, so that nothing on the screen goes to and fro.
#pragma once

#include "interaction/input/tracked_input.h"

#include <optional>
#include <utility>

namespace isochron::app {

template <class T>
class Dwell {
  public:
    static constexpr interaction::Seconds kBetween{0.5}; ///< two changes, at least

    explicit Dwell(T first = {}) : value_(std::move(first)) {}

    /// The value that was chosen last.
    const T& value() const { return value_; }
    /// Turns to the wanted value if the last change is long enough ago.
    /// @param now session time @param gone the value before cannot stay: another one comes at once
    /// @return the chosen value
    const T& turn(const T& wanted, interaction::Seconds now, bool gone = false) {
        if (wanted != value_ && (gone || !changed_ || now - *changed_ >= kBetween)) {
            value_ = wanted;
            changed_ = now;
        }
        return value_;
    }

  private:
    T value_;
    std::optional<interaction::Seconds> changed_;
};

} // namespace isochron::app
