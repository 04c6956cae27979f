// A log of all frames: how long each of their stages took, and sums of what they showed.
#pragma once

#include "app/frame/frame_rows.h"
#include "app/frame/frame_stages.h"
#include "app/frame/time_tally.h"
#include "index/file/read_use.h"

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>

namespace isochron::app {

/// How fast the newest frames came, for people.
struct FrameSpeed {
    TimeSummary times;
    double per_second = 0;
};

/// Keeps the newest frames whole, the times of the last ten minutes (at 60 frames per second), and
/// sums over all frames: its memory stays bounded however long a session lasts. The rows of a
/// report go to a file at once.
class FrameLog {
  public:
    static constexpr std::size_t kWhole = 1024, kTenMinutes = 60 * 60 * 10; ///< [frames]

    /// Writes a row for each further frame to the file of a report, which `finish_report` completes.
    /// @throws index::Error when it cannot be made
    void report_to(const std::filesystem::path& file);
    void add(const FrameReport& frame);
    /// Number of the next frame to be added, from 0.
    std::uint64_t next() const { return dropped_ + times_.size(); }
    /// Adds the GPU time to a frame's report, if that is still kept.
    void set_gpu(std::uint64_t frame, Milliseconds time);
    /// The newest `kWhole` frames.
    const std::deque<FrameReport>& frames() const { return frames_; }

    /// Times of one stage in the newest `count` frames (0: in all, within one percent where there
    /// are more than `kTenMinutes`); of drawing, in redrawn frames only.
    /// @param count at most `kTenMinutes`
    TimeSummary stage(FrameStage stage, std::size_t count = 0) const;

    /// Times of one stage in all frames for which they are known, within one percent where there
    /// are many.
    TimeSummary known(FrameSometimes time) const;
    std::uint64_t missed() const { return missed_; } ///< sum over all frames
    std::uint64_t frames_with(render::Footprint footprint) const {
        return footprints_[static_cast<std::size_t>(footprint)];
    }

    /// Frames that moved and showed cells, and how many of these frames showed the surface itself, or
    /// were promised a longer time than wanted.
    struct Moving {
        std::uint64_t frames = 0, as_surface = 0; ///< as mesh or exact surface
        std::uint64_t slower = 0;                 ///< so that the picture is recognized
    };
    const Moving& moving() const { return moving_; }
    /// How often the picture came to rest, how many rests came to an exact surface, and for these the
    /// time [ms] from the last moving frame until it was shown.
    struct Rests {
        std::uint64_t count = 0, exact = 0;
        TimeTally exact_after;
    };
    const Rests& rests() const { return rests_; }

    /// Frames that took more than two budgets, and more than three; by the stage that took most of
    /// them, as `longest_stage` says.
    struct Late {
        std::uint64_t over_two = 0, over_three = 0;
        std::map<std::string, std::uint64_t> stages;
    };
    const Late& late() const { return late_; }

    /// Rate of the newest `count` frames, by their session times without the waits; 0 before the
    /// second frame.
    double frames_per_second(std::size_t count) const;

    /// The speed of 120 frames, up to the last picture that was drawn anew. While frames show the
    /// same picture the speed stays as it is: otherwise the number alone would change the panel.
    const FrameSpeed& speed() const { return speed_; }

    /// Completes the report of `report_to` with a summary per stage.
    /// @param context description of the GL context, for the reader
    /// @param reading what was read from the index since it was opened
    /// @throws index::Error, also when a row could not be written
    void finish_report(const std::string& context, const index::ReadUse& reading);

    /// A few lines for a terminal.
    std::string table() const;

  private:
    static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    /// Frames whose rows wait for their GPU times.
    static constexpr std::uint64_t kOpen = 64;
    /// What summaries need of a frame: milliseconds, and its session time in seconds.
    struct Times {
        std::array<double, kFrameStages.size()> stages{};
        double gpu = kUnknown, pose_age = kUnknown;
        double at = 0;
        bool redrawn = true, after_wait = false;
    };
    static_assert(sizeof(Times) <= 120);

    static Times times_of(const FrameReport& frame);
    static bool belongs(const Times& times, std::size_t stage);
    void count(const FrameReport& frame);
    void tell_rows(std::uint64_t left);

    std::deque<FrameReport> frames_;
    std::deque<Times> times_;
    std::uint64_t dropped_ = 0; ///< frames before those of `times_`
    std::array<TimeTally, kFrameStages.size()> tallies_;
    TimeTally gpu_, ages_;
    std::uint64_t missed_ = 0;
    std::array<std::uint64_t, render::kFootprints> footprints_{};
    render::UploadCount uploaded_;
    Moving moving_;
    Late late_;
    Rests rests_;
    /// When the picture moved last, while no rest has come to its end since.
    std::optional<interaction::Seconds> moved_;
    bool resting_ = false;
    std::optional<FrameRows> rows_;
    std::uint64_t told_ = 0; ///< number of the next frame for `rows_`
    FrameSpeed speed_;
};

} // namespace isochron::app
