// Runs a check with every version of SIMD code, including plain code.
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>

namespace isochron::index {

/// Calls `check` once for every version that this processor can run.
template <class Check>
void on_every_simd_target(Check&& check) {
    std::int64_t rest = hwy::SupportedTargets() | HWY_SCALAR;
    for (; rest != 0; rest &= rest - 1) {
        const std::int64_t target = rest & -rest;
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::GetChosenTarget().Update(target);
        check();
    }
    hwy::GetChosenTarget().DeInit(); // the best one again
}

} // namespace isochron::index
