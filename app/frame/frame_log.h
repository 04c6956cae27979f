// A log of all frames: what each showed, and how long each of its stages took.
#pragma once

#include "app/frame/frame_report.h"
#include "index/file/read_use.h"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Median, 99th percentile and largest of some times.
struct TimeSummary {
    double median = 0, p99 = 0, worst = 0; ///< milliseconds
};
TimeSummary summarize(std::vector<double> milliseconds);

/// How fast the newest frames came, for people.
struct FrameSpeed {
    TimeSummary times;
    double per_second = 0;
};

/// Keeps the newest frames only, an hour at 60 frames per second, as a session may last for days.
class FrameLog {
  public:
    static constexpr std::size_t kTenMinutes = 60 * 60 * 10, kHour = 6 * kTenMinutes; ///< [frames]

    /// How many are kept from now on. Each takes some two kilobytes.
    void keep(std::size_t frames) { most_ = frames; }
    void add(const FrameReport& frame);
    /// Number of the next frame to be added, from 0.
    std::uint64_t next() const { return dropped_ + frames_.size(); }
    /// Adds the GPU time to a frame's report, if that is still kept.
    void set_gpu(std::uint64_t frame, Milliseconds time);
    const std::deque<FrameReport>& frames() const { return frames_; }

    /// Times of one stage in the newest `count` frames (0: all); of drawing, in redrawn frames
    /// only.
    TimeSummary stage(Milliseconds FrameReport::*stage, std::size_t count = 0) const;

    /// Times of one stage in all frames for which they are known.
    TimeSummary known(std::optional<Milliseconds> FrameReport::*time) const;
    unsigned missed() const; ///< sum over all kept frames
    std::uint64_t frames_with(render::Footprint footprint) const;

    /// Frames that moved and showed cells, and how many of these frames showed the surface itself, or
    /// were promised a longer time than wanted.
    struct Moving {
        std::uint64_t frames = 0, as_surface = 0; ///< as mesh or exact surface
        std::uint64_t slower = 0;                 ///< so that the picture is recognized
    };
    Moving moving() const;
    /// How often the picture came to rest, and for the rests with an exact surface the time from
    /// the last moving frame until it was shown.
    struct Rests {
        std::uint64_t count = 0;
        std::vector<double> exact_after; ///< [ms]
    };
    Rests rests() const;

    /// Frames that took more than two budgets, and more than three; by the stage that took most of
    /// them, as `longest_stage` says.
    struct Late {
        std::uint64_t over_two = 0, over_three = 0;
        std::map<std::string, std::uint64_t> stages;
    };
    Late late() const;

    /// Rate of the newest `count` frames, by their session times without the waits; 0 before the
    /// second frame.
    double frames_per_second(std::size_t count) const;

    /// The speed of 120 frames, up to the last picture that was drawn anew. While frames show the
    /// same picture the speed stays as it is: otherwise the number alone would change the panel.
    const FrameSpeed& speed() const { return speed_; }

    /// Writes JSON with a summary per stage and a row per frame; the file appears when complete.
    /// @param context description of the GL context, for the reader
    /// @param reading what was read from the index since it was opened
    /// @throws index::Error
    void write(const std::filesystem::path& path, const std::string& context,
               const index::ReadUse& reading) const;

    /// Sum over all kept frames.
    render::UploadCount uploaded() const;

    /// A few lines for a terminal.
    std::string table() const;

  private:
    std::deque<FrameReport> frames_;
    std::size_t most_ = kHour;  ///< kept
    std::uint64_t dropped_ = 0; ///< frames before those kept
    FrameSpeed speed_;
};

} // namespace isochron::app
