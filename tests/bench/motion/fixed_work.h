// The static control: work that is always the same, so that what makes it late is the machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace isochron::bench {

class FixedWork {
  public:
    /// Shares of the pieces that took more than two and three times the promised time.
    struct Late {
        double over_two = 0, over_three = 0;
    };
    /// Works in pieces on all processors, one each promised time.
    /// @param ms of each processor that a piece takes @param seconds for how long
    Late run(double ms, double promised_ms, double seconds,
             const std::function<void()>& check) const;
};

} // namespace isochron::bench
