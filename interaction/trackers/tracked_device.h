// One device of a tracker: what its samples, buttons and valuators come to in a frame.
#pragma once

#include "interaction/pose_history.h"
#include "interaction/trackers/calibration.h"
#include "interaction/trackers/pose_filter.h"

#include <string>
#include <vector>

namespace isochron::interaction {

/// Poses are stated for the time at which the picture that they lead to is seen.
struct PredictionOptions {
    bool on = true;
    Seconds display_delay{0.025}; ///< from the poll of a frame until its picture is seen
    Seconds limit{0.05};          ///< never further than this from the measurement
    Seconds smoothing{0.05};      ///< over which a velocity is estimated that no device tells
    bool operator==(const PredictionOptions&) const = default;
};

/// One of the source's valuators, scaled: a factor of -1 turns it round.
struct ValuatorSource {
    std::size_t index;
    float factor = 1.0f;
    bool operator==(const ValuatorSource&) const = default;
};

/// What is configured for one device.
struct DeviceOptions {
    std::string name;     ///< as the program knows it: `head`, `wand`, ...
    bool has_pose = true; ///< false: buttons and valuators only
    Calibration calibration;
    Seconds latency{0}; ///< from the measurement until the tracker sends it
    PoseFilterLimits limits;
    PredictionOptions prediction;
    std::vector<std::size_t> buttons; ///< the source's button for each bit; empty: as they come
    std::vector<ValuatorSource> valuators; ///< empty: as they come
};

/// Collects what came since the last poll. The pose goes through calibration, filter and
/// prediction; buttons and valuators go to rest when the device has not been heard of for
/// `limits.lost_after`, so that a tracker that stops leaves nothing pressed.
class TrackedDevice {
  public:
    static constexpr std::size_t kMostButtons = 64, kMostValuators = 16;

    explicit TrackedDevice(DeviceOptions options);
    const std::string& name() const { return options_.name; }

    /// The device's voice: called with every message that concerns it.
    void heard(Seconds now) { heard_ = now; }
    /// @param time session time of arrival, or of the measurement where that is known
    /// @param sensor in the tracker's frame [m]; anything that is not a pose is counted and refused
    void add_pose(Seconds time, const Pose& sensor, std::optional<Velocity> velocity = std::nullopt,
                  std::optional<Seconds> device_time = std::nullopt);
    /// Something that should have been a pose.
    void refuse_pose() { filter_.refuse(); }
    /// By the source's numbering; numbers beyond the limits and values that are not finite are
    /// ignored.
    void set_button(std::size_t index, bool down);
    void set_buttons(std::uint64_t bits);
    void set_valuator(std::size_t index, float value);

    /// State as of `now`. A button that was down at any time since the last poll is down.
    DeviceState poll(Seconds now);
    /// Its pose alone, of what has come since too, for the time at which the picture of the last
    /// poll's frame is seen. @param now not before the last poll
    DeviceState latch(Seconds now) const;

    const PoseFilterCounts& counts() const { return filter_.counts(); }
    /// `  head: 3600 poses, 2 no poses, 0 late, 12 jumped, 1 moved on`.
    std::string status() const;

  private:
    Velocity velocity() const;
    /// @param display_delay from now until the picture is seen
    void state_pose(DeviceState& state, Seconds now, Seconds display_delay) const;
    std::uint64_t mapped_buttons() const;
    std::vector<float> mapped_valuators() const;

    DeviceOptions options_;
    PoseFilter filter_;
    PoseHistory history_;
    std::optional<Seconds> heard_;
    Seconds polled_{0}; ///< last
    std::uint64_t buttons_ = 0, tapped_ = 0;
    std::vector<float> valuators_;
};

} // namespace isochron::interaction
