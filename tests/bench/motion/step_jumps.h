// How much more of the picture changes at a step than between steps, while time plays.
#pragma once

#include "index/file/index_file.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

namespace isochron::bench {

struct StepJumps {
    double worst = 0, median = 0; ///< steps: change into or out of one, over a frame's median
    std::size_t steps = 0;        ///< that were looked at
    double frames_of_step = 0;    ///< as the series plays at a tenth of its first speed
};

/// Plays around some steps, at a tenth of the speed and 60 frames a second, with exact pictures of
/// 512 x 512 pixels, and compares each picture with the next one.
/// @param isovalue none: as the explorer shows the data first
/// @param check called for each picture; may throw
/// @throws Error as a session does, and if no step lies between two others
StepJumps jumps_at_steps(const std::shared_ptr<const index::IndexFile>& file,
                         std::optional<double> isovalue, const std::function<void()>& check);

} // namespace isochron::bench
