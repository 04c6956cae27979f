// Displays and viewers of a configured installation.
#include "app/output/displays.h"

#include "render/gl/driver.h"
#include "render/gl/limits.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace isochron::app {
namespace {

constexpr int kSmooth = 4;

/// @throws render::Error when this GL has fewer
void check_samples(const char* where, int samples, const render::Gl& gl) {
    if (samples > render::max_samples(gl))
        throw render::Error("{}: expected 0 to {} with this GL, got {}", where,
                            render::max_samples(gl), samples);
}

int samples_of(const Config& config, const render::Gl& gl) {
    check_samples("rendering.samples", config.rendering.samples, gl);
    if (config.rendering.samples > 0)
        return config.rendering.samples;
    return render::draws_in_software(gl) ? 1 : std::min(kSmooth, render::max_samples(gl));
}

int picture_samples_of(const Config& config, const render::Gl& gl, glm::ivec2 window) {
    check_samples("rendering.picture_samples or --samples", config.pictures.samples, gl);
    if (config.pictures.samples > 0)
        return config.pictures.samples;
    // Color and depth of 2^28 samples take 2 GiB; two eyes in an 8K window need less.
    constexpr double kMost = 1 << 28;
    const double pixels = 2.0 * window.x * window.y;
    const int smooth = pixels * kSmooth <= kMost ? std::min(kSmooth, render::max_samples(gl)) : 1;
    return std::max(smooth, samples_of(config, gl));
}

} // namespace

stereo::DisplayOptions display_options(const render::Gl& gl, const Config& config) {
    render::expect_enough(gl);
    return {.near_plane = config.installation.near_plane,
            .far_plane = config.installation.far_plane,
            .background = config.rendering.background,
            .samples =
                config.pictures.only_kept
                    ? picture_samples_of(config, gl, config.installation.windows.front().size)
                    : samples_of(config, gl)};
}

stereo::DisplayOptions picture_options(const render::Gl& gl, const Config& config,
                                       glm::ivec2 window) {
    stereo::DisplayOptions options = display_options(gl, config);
    options.samples = picture_samples_of(config, gl, window);
    options.passes = std::max(1, config.pictures.passes);
    return options;
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

std::vector<stereo::ViewerPose> viewer_poses(const stereo::Installation& installation,
                                             const interaction::InputState& input,
                                             float eye_separation,
                                             const std::optional<glm::dvec3>& center) {
    std::vector<stereo::ViewerPose> found;
    for (const stereo::Viewer& viewer : installation.viewers) {
        const interaction::DeviceState* head = input.find(viewer.head);
        const interaction::Pose waiting{viewer.position, {1.0f, 0.0f, 0.0f, 0.0f}};
        const interaction::Pose pose = head && head->pose ? *head->pose : waiting;
        constexpr double kNearest = 0.1; // [m]
        const double away = center ? glm::distance(*center, glm::dvec3(pose.position)) : 0.0;
        found.push_back(
            {pose, eyes_of_viewer(viewer, eye_separation_of(viewer, installation, eye_separation)),
             center ? static_cast<float>(std::max(away, kNearest)) : 0.0f});
    }
    return found;
}

} // namespace isochron::app
