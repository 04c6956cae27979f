// Names of OpenXR's results.
#include "stereo/openxr/openxr_error.h"

#include <openxr/openxr_reflection.h>

#include <fmt/format.h>

namespace isochron::stereo {

std::string name_of(XrResult result) {
    switch (result) {
#define ISOCHRON_RESULT_NAME(name, value)                                                          \
    case name: return #name;
        XR_LIST_ENUM_XrResult(ISOCHRON_RESULT_NAME)
#undef ISOCHRON_RESULT_NAME
            default : return fmt::format("XrResult {}", static_cast<int>(result));
    }
}

XrResult check(XrResult result, const char* call) {
    if (XR_FAILED(result))
        throw OpenXrError(result, fmt::format("OpenXR: {} gives {}", call, name_of(result)));
    return result;
}

} // namespace isochron::stereo
