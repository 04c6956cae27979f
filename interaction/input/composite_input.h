// Combines several input sources into one.
#pragma once

#include "interaction/input/tracked_input.h"

#include <memory>

namespace isochron::interaction {

/// Combines what two sources say of one device. The pose is the first source's; if that has none,
/// it is the second one's, which counts as lost if the first source tracks the device but has had
/// no pose yet. A button is down if it is down in either. A valuator is the first source's unless
/// that is at rest.
DeviceState merged(const DeviceState& first, const DeviceState& second);

/// States every device of every source, in the order of the sources. A device that several sources
/// state is merged in that order.
class CompositeInput final : public TrackedInput {
  public:
    void add(std::unique_ptr<TrackedInput> source) { sources_.push_back(std::move(source)); }
    bool empty() const { return sources_.empty(); }
    InputState poll(Seconds now) override;
    InputState latch(Seconds now) override;
    void begin() override;
    std::vector<std::string> status() const override;

  private:
    std::vector<std::unique_ptr<TrackedInput>> sources_;
};

/// The devices of `first` and then the devices of `second`, merged.
InputState merged(InputState first, const InputState& second);

} // namespace isochron::interaction
