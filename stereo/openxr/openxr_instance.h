// The connection to an OpenXR runtime and its headset.
#pragma once

#include "stereo/headset.h"
#include "stereo/openxr/openxr_options.h"

#include <openxr/openxr.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace isochron::stereo {

/// Sizes of one eye's picture, from the runtime [pixel].
struct EyeSize {
    glm::ivec2 recommended, most;
};

class OpenXrInstance {
  public:
    /// @throws OpenXrError when there is no runtime, or it cannot show OpenGL; it tells what was
    /// looked for, where, and what was found
    explicit OpenXrInstance(const OpenXrOptions& options);
    ~OpenXrInstance();
    OpenXrInstance(const OpenXrInstance&) = delete;
    OpenXrInstance& operator=(const OpenXrInstance&) = delete;

    XrInstance handle() const { return instance_; }
    /// How contexts are passed to the runtime.
    OpenXrBinding binding() const { return binding_; }
    bool has(const char* extension) const { return enabled_.contains(extension); }

    /// Looks for a headset. @return whether there is one now
    /// @throws OpenXrError when there can never be one
    bool find_headset();
    XrSystemId headset() const { return system_; }
    std::vector<EyeSize> eye_sizes() const; ///< left, right

    /// The next event; empty if there is none.
    std::optional<XrEventDataBuffer> next_event() const;

    XrPath path(const char* text) const;
    /// An entry point of an extension. @throws OpenXrError when the runtime has none
    template <typename Function>
    Function function(const char* name) const {
        return reinterpret_cast<Function>(entry_point(name));
    }
    /// `Monado(XRT) by Collabora et al 25.1.0, Simulated HMD`
    std::string description() const;

  private:
    void create(const std::vector<const char*>& extensions);
    PFN_xrVoidFunction entry_point(const char* name) const;

    OpenXrBinding binding_{};
    std::set<std::string, std::less<>> enabled_;
    XrInstance instance_ = XR_NULL_HANDLE;
    XrSystemId system_ = XR_NULL_SYSTEM_ID;
};

} // namespace isochron::stereo
