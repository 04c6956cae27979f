// Compares the session's clock with an OpenXR runtime's.
#include "stereo/openxr/openxr_clock.h"

#include "stereo/openxr/openxr_error.h"
#include "stereo/openxr/openxr_instance.h"

#define XR_USE_TIMESPEC
#include <ctime>
#include <openxr/openxr_platform.h>

namespace isochron::stereo {

OpenXrClock::OpenXrClock(const OpenXrInstance& instance) {
    if (instance.has(XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME))
        convert_ = instance.function<PFN_xrVoidFunction>("xrConvertTimespecTimeToTimeKHR");
}

void OpenXrClock::compare(const OpenXrInstance& instance, interaction::Seconds now) {
    if (!convert_)
        return;
    const auto convert = reinterpret_cast<PFN_xrConvertTimespecTimeToTimeKHR>(convert_);
    timespec monotonic{};
    clock_gettime(CLOCK_MONOTONIC, &monotonic); // the clock that the extension converts
    check(convert(instance.handle(), &monotonic, &here_), "xrConvertTimespecTimeToTimeKHR");
    now_ = now;
}

void OpenXrClock::told(XrTime display_time, XrDuration period, interaction::Seconds now) {
    if (convert_)
        return;
    here_ = display_time - period;
    now_ = now;
}

interaction::Seconds OpenXrClock::session_time(XrTime time) const {
    return now_ + interaction::Seconds(1e-9 * static_cast<double>(time - here_));
}

} // namespace isochron::stereo
