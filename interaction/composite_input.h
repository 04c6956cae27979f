// Several sources of input as one.
#pragma once

#include "interaction/tracked_input.h"

#include <memory>

namespace isochron::interaction {

/// Two sources' states of one device. The first one owns the pose: while it has none at all, the
/// second one's stands in and counts as lost. Buttons are down when they are down in either;
/// valuators are the first one's where they are off rest.
DeviceState merged(const DeviceState& first, const DeviceState& second);

/// Every device that any source states, in the order of the sources; a device of several sources is
/// merged in that order.
class CompositeInput final : public TrackedInput {
  public:
    void add(std::unique_ptr<TrackedInput> source) { sources_.push_back(std::move(source)); }
    InputState poll(Seconds now) override;
    InputState latch(Seconds now) override;
    void begin() override;
    std::vector<std::string> status() const override;

  private:
    std::vector<std::unique_ptr<TrackedInput>> sources_;
};

/// The devices of `first`, then those of `second`, merged.
InputState merged(InputState first, const InputState& second);

} // namespace isochron::interaction
