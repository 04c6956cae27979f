// Helpers to test controls: devices, a session's state, and frames of a fixed length.
#pragma once

#include "interaction/controls/controls.h"
#include "interaction/navigation/navigation.h"
#include "tests/interaction/input_builders.h"
#include "tests/interaction/obeyed.h"

#include <gtest/gtest.h>

namespace isochron::interaction {

/// Controls with a session around them that obeys every command.
class Desk {
  public:
    Desk(const Desk&) = delete; // the context points into it
    Desk& operator=(const Desk&) = delete;
    std::vector<double> times{0, 1, 2, 3, 4};
    std::vector<std::string> modes{"mono", "side_by_side", "top_bottom"};
    Settings settings;
    ControlContext context{.settings = settings};

    Desk() {
        settings.set_isovalue(50);
        context.series.times = &times;
        context.series.high = 100;
        context.stereo_modes = &modes;
        context.series.home = {{0.1, 1.3, -1.5}, glm::dquat(1, 0, 0, 0), 0.01};
        settings.room_from_physical = context.series.home;
        context.series.pivot = {30, 25, 30};
        context.data = {glm::dmat4(60, 0, 0, 0, 0, 50, 0, 0, 0, 0, 60, 0, 0, 0, 0, 1), "mm"};
    }
    Commands frame(std::vector<DeviceState> devices, double elapsed = 1.0 / 60) {
        now_ += elapsed;
        Commands commands = controls_.update({Seconds(now_), std::move(devices)}, context);
        merge(commands, controls_.take_found());
        obey(commands, settings);
        return commands;
    }
    /// Presses keys for one frame and lets go for another.
    Commands tap(const ActionSet& actions) {
        Commands commands = frame({head_at(kStanding), keys_down(actions)});
        merge(commands, frame({head_at(kStanding), keys_down(0)}));
        return commands;
    }
    Commands tap(Action action) { return tap(bit(action)); }
    std::vector<std::string> notes() { return controls_.take_notes(); }
    /// The wheel, with the eye's ray through the cursor.
    Commands wheel(float notches, const std::optional<Pose>& ray = {}) {
        std::vector<float> valuators(kMouseValuators, 0.0f);
        valuators[kMouseWheel] = notches;
        std::vector<DeviceState> devices{head_at(kStanding), mouse_dragged(std::move(valuators))};
        if (ray)
            devices.push_back({"pointer", ray, true, 0, {}});
        return frame(std::move(devices));
    }
    const Similarity& volume() const { return settings.room_from_physical; }
    glm::dvec3 center() const { return transform(volume(), context.series.pivot); }

  private:
    Controls controls_;
    double now_ = 0;
};

inline void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

/// The physical point that lies at the room point `p`.
inline glm::dvec3 physical(const Similarity& volume, const glm::dvec3& p) {
    return glm::dvec3(glm::inverse(matrix(volume)) * glm::dvec4(p, 1));
}

} // namespace isochron::interaction
