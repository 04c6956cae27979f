// The parts of the check of a configuration.
#pragma once

#include "app/config/config.h"

#include <string>
#include <vector>

namespace isochron::app {

/// What has been found so far.
struct Findings {
    std::vector<ConfigProblem> found;

    void wrong(int line, const std::string& key, const std::string& text) {
        found.push_back({line, key, text, true});
    }
    void warn(int line, const std::string& key, const std::string& text) {
        found.push_back({line, key, text, false});
    }
};

/// A viewport, with its screen, in its window.
struct PlacedViewport {
    const stereo::Window& window;
    const stereo::Viewport& viewport;
    std::size_t number; ///< number of the viewport in its window, from 1
    int line = viewport.screen.line.number;
};
std::vector<PlacedViewport> viewports_of(const Config& config);

constexpr float kSeam = 0.005f; ///< [m] widest gap between screens that is no problem

/// Two screens that do not meet where they seem to be meant to.
struct ScreenGap {
    const stereo::Screen* a;
    const stereo::Screen* b;
    std::string name_a, name_b;
    int line = 0;    ///< line of b
    float width = 0; ///< [m]
};

/// One warning for the gaps between two walls, and one for all displays of a wall.
void check_gaps(const std::vector<ScreenGap>& gaps, const std::string& key, Findings& findings);

/// Warns of viewers, planes, screens and calibrations that are unlikely to be meant.
void check_measures(const Config& config, Findings& findings);

/// Heads without a tracker, ports that two trackers listen on, sources that two devices use, and
/// trackers that this program was built without.
void check_devices(const Config& config, Findings& findings);

} // namespace isochron::app
