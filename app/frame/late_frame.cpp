// Says what took the time of a late frame.
#include "app/frame/late_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace isochron::app {
namespace {

std::pair<const char*, Milliseconds> longest_of(const FrameReport& frame) {
    std::array<std::pair<const char*, Milliseconds>, 6> stages{{
        {"wait", frame.wait},
        {"upload", frame.upload},
        {"draw", frame.draw},
        {"barrier", frame.barrier},
        {"present", frame.present},
        {"rest", frame.total},
    }};
    for (std::size_t i = 0; i + 1 < stages.size(); ++i)
        stages.back().second -= stages[i].second;
    return *std::ranges::max_element(stages, {}, &std::pair<const char*, Milliseconds>::second);
}

} // namespace

Milliseconds due_time(const FrameReport& frame) {
    return std::max(frame.budget, frame.promised);
}

bool is_late(const FrameReport& frame) {
    const Milliseconds due = due_time(frame);
    return due.count() > 0 && frame.total > kLate * due;
}

const char* longest_stage(const FrameReport& frame) {
    return longest_of(frame).first;
}

std::string what_took(const FrameReport& frame, bool first) {
    const auto [stage, time] = longest_of(frame);
    std::string text =
        fmt::format("{} took {:.0f} of {:.0f} ms ({}, {}", stage, time.count(), frame.total.count(),
                    render::name_of(frame.footprint), name_of(frame.reason));
    if (frame.redrawn && first)
        text += ", for the first time";
    if (!frame.redrawn)
        text += ", not drawn again";
    if (frame.expected)
        text += fmt::format(", expected {:.0f} ms", frame.expected->count());
    if (frame.extracting)
        text += "; cells were being extracted";
    if (frame.uploaded.sets > 0)
        text += "; a set of cells came";
    if (frame.total.count() > 0)
        text += fmt::format("; {:.1f} processors worked", frame.processor / frame.total);
    return text + ")";
}

} // namespace isochron::app
