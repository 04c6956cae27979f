// Progress reports of long work.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace isochron::index {

/// Called now and then, from the thread that does the work, with the phase and its fraction done
/// in [0, 1]. Throwing from it cancels the work, which then leaves nothing behind.
using Progress = std::function<void(std::string_view phase, double fraction)>;

/// The report of one phase, as a function of the fraction; empty if `progress` is.
inline std::function<void(double)> phase_of(const Progress& progress, std::string phase) {
    if (!progress)
        return {};
    return [&progress, phase = std::move(phase)](double fraction) { progress(phase, fraction); };
}

} // namespace isochron::index
