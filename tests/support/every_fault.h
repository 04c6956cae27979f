// Which calls a test lets fail: some, and those that the environment's ISOCHRON_EVERY_FAULT says.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace isochron::test_support {

/// Whether ISOCHRON_EVERY_FAULT is there: `1` lets every call fail in turn, `3/8` the third of eight
/// shares of them, counted from 0.
inline bool tries_every_fault() {
    return std::getenv("ISOCHRON_EVERY_FAULT") != nullptr;
}

/// The numbers of the calls that fail in turn, ascending from 1.
class FaultyCalls {
  public:
    /// @param after the call after another one among those that always fail
    explicit FaultyCalls(long (*after)(long)) : after_(after) {
        const char* given = std::getenv("ISOCHRON_EVERY_FAULT");
        if (!given)
            return;
        long share = 0;
        if (std::sscanf(given, "%ld/%ld", &share, &step_) != 2 || share < 0 || step_ < 1)
            share = 0, step_ = 1;
        in_share_ = 1 + share % step_;
    }
    long next() {
        const long call = std::min(usual_, in_share_);
        if (call == in_share_)
            in_share_ += step_;
        if (call == usual_)
            usual_ = after_(call);
        return call;
    }

  private:
    long (*after_)(long);
    long usual_ = 1, in_share_ = std::numeric_limits<long>::max(), step_ = 1;
};

} // namespace isochron::test_support
