// A session that is scripted and run in real time: jumps of time, drags of the isovalue, walking in.
#pragma once

#include "index/file/index_file.h"

#include <cstddef>
#include <filesystem>
#include <memory>

namespace isochron::bench {

struct MinuteOptions {
    double seconds = 60;
    double low = 0, high = 0; ///< isovalues between which one is dragged
    int picture = 480;        ///< both sides of each eye's picture, pixels
    double budget_ms = 100;
    std::filesystem::path report; ///< for the log of all frames; empty: none
};

struct Minute {
    std::size_t frames = 0, redrawn = 0;
    std::size_t over_two = 0, over_three = 0; ///< frames that took more than so many budgets
    double median_ms = 0, worst_ms = 0;       ///< of redrawn frames
};

/// Every 20 seconds the same: 3 seconds of rest, 3 of dragging, 2 of jumps from step to step, and
/// after a second a walk into the volume and back.
/// @throws app::Canceled, index::Error
Minute measure_minute(const std::shared_ptr<const index::IndexFile>& file,
                      const MinuteOptions& options, const index::Progress& progress);

} // namespace isochron::bench
