// The stages of a frame, by the names that reports give them.
#pragma once

#include "app/frame/frame_report.h"

#include <array>
#include <optional>
#include <utility>

namespace isochron::app {

using FrameStage = Milliseconds FrameReport::*;
inline constexpr std::array<std::pair<const char*, FrameStage>, 9> kFrameStages{{
    {"search", &FrameReport::search},
    {"gather", &FrameReport::gather},
    {"wait", &FrameReport::wait},
    {"upload", &FrameReport::upload},
    {"draw", &FrameReport::draw},
    {"barrier", &FrameReport::barrier},
    {"present", &FrameReport::present},
    {"total", &FrameReport::total},
    {"latency", &FrameReport::latency},
}};
/// Times that are not known for every frame.
using FrameSometimes = std::optional<Milliseconds> FrameReport::*;
inline constexpr std::array<std::pair<const char*, FrameSometimes>, 2> kFrameSometimes{{
    {"gpu", &FrameReport::gpu},
    {"pose_age", &FrameReport::pose_age},
}};

} // namespace isochron::app
