// The steps that playing goes through, and when each of them is shown.
#pragma once

#include "interaction/setting_values.h"
#include "interaction/step_gaps.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::interaction {

/// Every so many steps of a range. A place is a number within the track, from 0; its time is counted
/// from the track's first step, in units of the data's time or, where the speed counts steps, in
/// places. The last place lasts as long as the others do on average.
class StepTrack {
  public:
    /// @param times physical times of the steps, increasing; not empty
    StepTrack(std::span<const double> times, const StepRange& range, const PlaybackState& state);

    std::uint32_t places() const { return places_; }
    std::uint32_t last() const { return places_ - 1; }
    std::uint32_t step(std::uint32_t place) const { return first_ + place * every_; }
    /// The place at which playing goes on from any step of the series: the step's own, else the next
    /// one in the direction of playing, else the one at which that direction begins.
    std::uint32_t place_of(std::uint32_t step, bool reverse) const;

    /// When a place begins; from `places()` on, when the track ends.
    double start(std::uint32_t place) const;
    double duration() const { return start(places_); }
    /// The place that is shown at a time.
    std::uint32_t place_at(double time) const;
    /// The instant at a time where steps are blended, rounded once. Only steps next to each other
    /// are: others are held, and so are the last one and those before a gap.
    /// @param gaps of the whole series
    Instant instant_at(double time, const StepGaps& gaps) const;
    /// When an instant of the track comes. @param reverse as `place_of`
    double time_of(Instant at, bool reverse) const;

  private:
    std::span<const double> times_;
    std::uint32_t first_ = 0, every_ = 1, places_ = 1;
    bool evenly_ = false; ///< all places last equally long
};

inline constexpr double kRoundSeconds = 10.0; ///< [s] of one whole series at speed 1

/// How far time that plays moves on a `StepTrack` in a second.
double track_rate(const PlaybackState& state, std::span<const double> times);

/// Physical duration of one round: last minus first time plus one mean step; 0 for one step.
double period(std::span<const double> times);

/// What a press of a step key leads to: `every` steps further, at the ends of the series around to
/// the other end if time loops, and else no further.
/// @param steps number of steps of the series, above 0
std::uint32_t next_step(std::uint32_t step, const PlaybackState& state, std::uint32_t steps);
/// Between two steps, the earlier one is the step before.
std::uint32_t previous_step(Instant now, const PlaybackState& state, std::uint32_t steps);

/// The ends of a range in a series. @param steps number of steps of the series, above 0
std::uint32_t first_of(const StepRange& range, std::uint32_t steps);
std::uint32_t last_of(const StepRange& range, std::uint32_t steps);

/// The range that begins or ends at a step; if it did so already, it begins or ends with the series.
/// The other end gives way where it would be on the wrong side.
StepRange begun_at(std::uint32_t step, StepRange range);
StepRange ended_at(std::uint32_t step, StepRange range);
/// For one button: begins a range at the step, then ends it there, then takes all steps again.
StepRange marked_at(std::uint32_t step, const StepRange& range);

/// The instant of the next bookmark after an instant, or before it; behind the last one comes the first.
/// @param blends time stops between steps, too; else all instants of a step are the same
std::optional<Instant> next_bookmark(std::span<const Bookmark> bookmarks, Instant now,
                                     bool blends = true);
std::optional<Instant> previous_bookmark(std::span<const Bookmark> bookmarks, Instant now,
                                         bool blends = true);

/// The bookmarks with an instant in addition, or without it if it is among them; the same ones if there
/// are kMostBookmarks of other instants.
std::vector<Bookmark> toggled_bookmark(std::vector<Bookmark> bookmarks, Instant at);

/// `step 4`, or between two steps `step 4.50`: as people count, from 1.
std::string name_of(Instant at);

/// As many pictures a second, counted in another unit.
PlaybackState counted_in(SpeedUnit unit, PlaybackState state, std::span<const double> times);
/// Faster or slower in the unit that counts. @param factor above 0
PlaybackState sped_up(PlaybackState state, double factor);

} // namespace isochron::interaction
