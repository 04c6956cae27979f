// A session that is scripted and run in real time: jumps of time, drags of the isovalue, walking
// in.
#pragma once

#include "index/file/index_file.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace isochron::bench {

struct MinuteOptions {
    double seconds = 60;
    double low = 0, high = 0; ///< isovalues between which one is dragged
    int picture = 480;        ///< both sides of each eye's picture, pixels
    double budget_ms = 100;
    std::filesystem::path report; ///< for the log of all frames; empty: none
};

struct MinuteFrames {
    std::size_t frames = 0, redrawn = 0;
    std::size_t over_two = 0, over_three = 0; ///< frames that took more than so many budgets
    double median_ms = 0, worst_ms = 0;       ///< of redrawn frames
    double percent(std::size_t some) const {  ///< of the redrawn ones
        return redrawn > 0 ? 100.0 * static_cast<double>(some) / static_cast<double>(redrawn) : 0;
    }
};

struct Minute {
    MinuteFrames scripted;
    MinuteFrames control;          ///< nothing but a head that sways
    std::vector<std::string> late; ///< a line for each frame of both over two budgets, in order
};

/// Every 20 seconds the same: 3 seconds of rest, 3 of dragging, 2 of jumps from step to step, and
/// after a second a walk into the volume and back. After each such round follow 10 seconds of the
/// control, so that what else the machine does falls on both.
/// @param options with the length of the script alone
/// @throws app::Canceled, index::Error
Minute measure_minute(const std::shared_ptr<const index::IndexFile>& file,
                      const MinuteOptions& options, const index::Progress& progress);

} // namespace isochron::bench
