// The time that is promised for each moving picture: as short as the picture can still be recognized.
#pragma once

#include "app/frame/milliseconds.h"
#include "app/quality/dwell.h"
#include "interaction/input/tracked_input.h"

#include <cstdint>
#include <optional>

namespace isochron::app {

/// What a moving picture is expected to take.
struct MotionCosts {
    Milliseconds beside{0};  ///< what is done for a frame besides drawing: presenting
    Milliseconds fixed{0};   ///< part of drawing that no number of cells changes
    Milliseconds of_cell{0}; ///< drawing one cell in all views
    double few_pixels = 1;   ///< share of drawing's time that is left in fewer pixels
};

/// Recognition comes before the rate. A picture is recognized if it has at least an eighth of the
/// cells of level 0: its light is then that of the settled picture. Where the wanted time does not
/// hold these, a longer time is promised. Where a screen's period is wanted, and nobody asked for a
/// shorter time, the promise is also as long as all cells need, within limits: an eye sees thin
/// parts that are missing sooner than it sees 30 pictures a second.
class MotionPromise {
  public:
    static constexpr double kLeastShare = 1.0 / 8;      ///< share of the cells that is recognized
    static constexpr double kRoom = 0.85;               ///< share of the promise that is planned
    static constexpr Milliseconds kAtEase{1000.0 / 30}; ///< for all cells
    static constexpr Milliseconds kLongest{100};        ///< for an eighth of them

    /// Times beyond the wanted one that may be promised; 0: none.
    struct Limits {
        Milliseconds all;   ///< for all cells
        Milliseconds least; ///< for the least share of them
    };
    explicit MotionPromise(Milliseconds wanted) : MotionPromise(wanted, Limits{}) {}
    MotionPromise(Milliseconds wanted, const Limits& limits)
        : wanted_(wanted), limits_(limits), time_(wanted) {}

    /// @param costs empty: not measured yet
    /// @param cells of level 0; empty: not known
    /// @param now session time
    void update(const std::optional<MotionCosts>& costs, std::optional<std::uint64_t> cells,
                interaction::Seconds now);
    Milliseconds time() const { return time_.value(); }
    Milliseconds wanted() const { return wanted_; }

  private:
    static Milliseconds needed(const MotionCosts& costs, double cells, double share = 1);

    Milliseconds wanted_;
    Limits limits_;
    Dwell<Milliseconds> time_;
};

/// The number of cells below which no moving picture goes: an eighth of level 0.
std::uint64_t least_recognized(std::optional<std::uint64_t> cells);

} // namespace isochron::app
