// Displays and viewers of a configured installation.
#include "app/displays.h"

#include "render/driver.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::app {
namespace {

/// @throws render::Error when this GL has fewer
int samples_of(const Config& config, const render::Gl& gl) {
    constexpr int kOnGpu = 4;
    if (config.samples == 0)
        return render::draws_in_software(gl) ? 1 : std::min(kOnGpu, render::max_samples(gl));
    if (config.samples > render::max_samples(gl))
        throw render::Error(fmt::format("rendering.samples: expected 0 to {} with this GL, got {}",
                                        render::max_samples(gl), config.samples));
    return config.samples;
}

} // namespace

stereo::DisplayOptions display_options(const render::Gl& gl, const Config& config) {
    return {.near_plane = config.installation.near_plane,
            .far_plane = config.installation.far_plane,
            .background = config.background,
            .samples = samples_of(config, gl)};
}

std::deque<stereo::Display> make_displays(const render::Gl& gl, const stereo::Windows& windows,
                                          const Config& config) {
    const stereo::DisplayOptions options = display_options(gl, config);
    std::deque<stereo::Display> displays;
    for (std::size_t i = 0; i < windows.count(); ++i)
        displays.emplace_back(gl, windows.drawing(), windows[i],
                              config.installation.windows[windows.number(i)], options);
    return displays;
}

std::vector<std::string> live_stereo_modes(const stereo::Windows& windows) {
    std::vector<std::string> names;
    for (const stereo::StereoMode mode : stereo::all_stereo_modes())
        if (!stereo::is_inverted(mode) &&
            (mode != stereo::StereoMode::quadbuffer || windows[0].has_stereo_buffers()))
            names.emplace_back(stereo::name_of(mode));
    return names;
}

std::vector<stereo::Viewpoint> viewpoints(const stereo::Installation& installation,
                                          const interaction::InputState& input,
                                          float eye_separation) {
    std::vector<stereo::Viewpoint> found;
    for (const stereo::Viewer& viewer : installation.viewers) {
        const interaction::DeviceState* head = input.find(viewer.head);
        const interaction::Pose waiting{viewer.position, {1.0f, 0.0f, 0.0f, 0.0f}};
        found.push_back({head && head->pose ? *head->pose : waiting,
                         eye_separation_of(viewer, installation, eye_separation)});
    }
    return found;
}

} // namespace isochron::app
