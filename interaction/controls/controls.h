// Turns device states into commands: navigation, isovalue, time, and the program's switches.
#pragma once

#include "interaction/commands.h"
#include "interaction/control_context.h"
#include "interaction/input/actions.h"
#include "interaction/input/tracked_input.h"

#include <memory>
#include <string>
#include <vector>

namespace isochron::interaction {

/// From one click of a double click to the next, at most.
constexpr Seconds kDoubleClick{0.4};

/// Depends only on the device states and contexts that it was given: the same sequence gives the
/// same commands.
class Controls {
  public:
    Controls();
    ~Controls();
    /// Advances by one frame. The commands include the step that playback has reached.
    Commands update(const InputState& input, const ControlContext& context);

    /// Whether the next frames show the way to a step of the story. @param told `Settings::story`
    bool tells_on(std::uint32_t told) const;

    /// The part of the commands that depends on the surfaces shown, not on devices alone (places
    /// that tools found): `update` keeps it until it is taken.
    Commands take_found();
    /// Messages of the tools, for people; kept until they are taken.
    std::vector<std::string> take_notes();

    /// The controls of all devices, for `--help` and the panel.
    static std::vector<ControlGroup> documentation();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::interaction
