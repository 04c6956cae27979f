// Errors of OpenXR calls.
#pragma once

#include "render/gl/gl.h"

#include <openxr/openxr.h>

#include <cstdint>
#include <string>
#include <vector>

namespace isochron::stereo {

class OpenXrError : public render::Error {
  public:
    OpenXrError(XrResult what, const std::string& text) : render::Error(text), result(what) {}
    XrResult result;
};

/// `XR_ERROR_RUNTIME_UNAVAILABLE`; `XrResult -1000` for a result that this version does not know.
std::string name_of(XrResult result);

/// @throws OpenXrError naming the call and the result, unless the result is a success
/// @return the result, which may be a qualified success
XrResult check(XrResult result, const char* call);

/// The list from an OpenXR function that is called twice: for the number of items, then for the
/// items.
template <typename T, typename Call>
std::vector<T> enumerated(const char* name, T blank, Call call) {
    std::uint32_t count = 0;
    check(call(0, &count, static_cast<T*>(nullptr)), name);
    std::vector<T> items(count, blank);
    check(call(count, &count, items.data()), name);
    items.resize(count);
    return items;
}

} // namespace isochron::stereo
