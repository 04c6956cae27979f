// Turns device states into commands: navigation, isovalue, time, and the program's switches.
#pragma once

#include "interaction/actions.h"
#include "interaction/commands.h"
#include "interaction/control_context.h"
#include "interaction/tracked_input.h"

#include <memory>
#include <string>
#include <vector>

namespace isochron::interaction {

/// Pure function of the device states and contexts it was given: the same sequence, the same
/// commands.
class Controls {
  public:
    Controls();
    ~Controls();
    /// One frame. Includes the step that playback has reached in physical time.
    Commands update(const InputState& input, const ControlContext& context);

    /// What tools found in that frame among what is shown: devices alone do not explain it.
    const Commands& found() const;
    /// What tools had to say in that frame, for people.
    const std::vector<std::string>& notes() const;

    /// What all devices do, for `--help` and the panel.
    static std::vector<ControlGroup> documentation();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::interaction
