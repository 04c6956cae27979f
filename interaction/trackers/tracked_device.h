// One device of a tracker: turns its samples, buttons and valuators into its state in a frame.
#pragma once

#include "interaction/pose_history.h"
#include "interaction/trackers/calibration.h"
#include "interaction/trackers/pose_filter.h"

#include <string>
#include <vector>

namespace isochron::interaction {

/// Prediction states a pose for the time at which the picture made from it is seen.
struct PredictionOptions {
    bool on = true;
    Seconds display_delay{0.025}; ///< from the poll of a frame until its picture is seen
    Seconds limit{0.05};          ///< longest prediction beyond the measurement
    Seconds smoothing{0.05};      ///< over which velocity is estimated if the device sends none
    bool operator==(const PredictionOptions&) const = default;
};

/// What is configured for one device.
struct DeviceOptions {
    std::string name;     ///< as the program knows it: `head`, `wand`, ...
    bool has_pose = true; ///< false: buttons and valuators only
    Calibration calibration;
    Seconds latency{0}; ///< from the measurement until the tracker sends it
    PoseFilterLimits limits;
    PredictionOptions prediction;
    std::vector<std::uint32_t> buttons;   ///< the source's button for each bit; empty: the same bits
    std::vector<std::uint32_t> valuators; ///< the source's, by number; empty: all, in its order
    std::vector<float> valuator_factors;  ///< for each of `valuators`, -1 reverses it; empty: 1
};

/// Collects what has arrived since the last poll. The pose goes through calibration, filter and
/// prediction. Buttons and valuators go to rest when nothing has been heard from the device for
/// `limits.lost_after`, so that a tracker that stops leaves nothing pressed.
class TrackedDevice {
  public:
    static constexpr std::size_t kMostButtons = 64, kMostValuators = 16;

    explicit TrackedDevice(DeviceOptions options);
    const std::string& name() const { return options_.name; }

    /// Notes that the device has sent something; call it with every message of the device.
    void heard(Seconds now) { heard_ = now; }
    /// @param time session time of the measurement, or of arrival if that is not known; the
    ///        configured latency is subtracted
    /// @param sensor in the tracker's frame [m]; counted and refused if it is not a pose
    void add_pose(Seconds time, const Pose& sensor, std::optional<Velocity> velocity = std::nullopt,
                  std::optional<Seconds> device_time = std::nullopt);
    /// Counts something that should have been a pose but is none.
    void refuse_pose() { filter_.refuse(); }
    /// Set buttons and valuators, numbered as the source does. Numbers beyond the limits and values
    /// that are not finite are ignored.
    void set_button(std::size_t index, bool down);
    void set_buttons(std::uint64_t bits);
    void set_valuator(std::size_t index, float value);

    /// State as of `now`. A button that was down at any time since the last poll is down.
    DeviceState poll(Seconds now);
    /// The pose only, with the samples that have arrived since the last poll, for the time at which
    /// the picture of that poll's frame is seen. @param now not before the last poll
    DeviceState latch(Seconds now) const;

    const PoseFilterCounts& counts() const { return filter_.counts(); }
    /// `  head: 3600 poses, 2 refused as none, 0 late, 12 jumped, 1 moved on`.
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
    Seconds polled_{0}; ///< time of the last poll
    std::uint64_t buttons_ = 0, tapped_ = 0;
    std::vector<float> valuators_;
};

} // namespace isochron::interaction
