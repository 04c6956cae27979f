// What somebody does in front of the data: a head and commands for each moment of a motion.
#pragma once

#include "app/frame/explorer_state.h"
#include "interaction/commands.h"
#include "interaction/input/tracked_input.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace isochron::bench {

enum class Motion : std::uint8_t {
    sway,    ///< the head moves a few centimeters
    walk_in, ///< the head goes to the data and into them
    orbit,   ///< the data turn, as when they are dragged with the mouse
    scrub,   ///< the isovalue is dragged up, down and back
    jump_on  ///< another step is shown, four times a second
};
inline constexpr std::array<std::string_view, 5> kMotionNames{"sway", "walk-in", "orbit", "scrub",
                                                              "jump-on"};
inline std::string_view name_of(Motion motion) {
    return kMotionNames[static_cast<std::size_t>(motion)];
}
/// Whether it asks for other cells; else the same ones are seen from elsewhere.
inline bool asks_for_cells(Motion motion) {
    return motion == Motion::scrub || motion == Motion::jump_on;
}
/// @param name one of kMotionNames
Motion motion_from_name(std::string_view name);

class MotionScript {
  public:
    /// @param start what is shown before the motion @param center of the data, physical space
    MotionScript(Motion motion, double seconds, app::ExplorerState start, const glm::dvec3& center,
                 std::size_t steps)
        : motion_(motion), seconds_(seconds), start_(std::move(start)), center_(center),
          steps_(steps) {}

    /// The devices at a moment of the motion; they stay where they are at its end.
    /// @param session time @param at 0 to the length of the motion
    interaction::InputState input(double session, double at) const;
    /// What is asked for at that moment.
    interaction::Commands commands(double at) const;

  private:
    Motion motion_;
    double seconds_;
    app::ExplorerState start_;
    glm::dvec3 center_;
    std::size_t steps_;
};

} // namespace isochron::bench
