// Warns of gaps between screens, once for each wall.
#pragma once

#include "app/config/config_problem.h"
#include "stereo/installation.h"

#include <string>
#include <vector>

namespace isochron::app {

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
std::vector<ConfigProblem> problems_of_gaps(const std::vector<ScreenGap>& gaps,
                                            const std::string& key);

} // namespace isochron::app
