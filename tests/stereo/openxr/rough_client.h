// A small OpenXR program that shows a few frames, correctly or with one mistake.
#pragma once

#include "stereo/context/native_gl.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace isochron::played {

enum class Mistake : std::uint8_t {
    none,
    requirements_not_asked,
    begins_before_ready,
    begins_frame_without_wait,
    waits_twice,
    ends_frame_without_begin,
    ends_frame_for_another_time,
    releases_image_without_wait,
    keeps_image,
    never_locates_views,
    exchanges_eyes,
    shows_more_than_the_image,
    asks_for_another_format,
    attaches_twice,
    suggests_late,
    reads_before_sync,
    forgets_a_type,
    leaves_while_running
};

/// What the runtime is to call each mistake.
struct MistakeCode {
    Mistake mistake;
    std::string_view code;
};
inline constexpr std::array kMistakes{
    MistakeCode{Mistake::requirements_not_asked, "requirements_not_asked"},
    MistakeCode{Mistake::begins_before_ready, "begin_before_ready"},
    MistakeCode{Mistake::begins_frame_without_wait, "begin_without_wait"},
    MistakeCode{Mistake::waits_twice, "wait_twice"},
    MistakeCode{Mistake::ends_frame_without_begin, "end_without_begin"},
    MistakeCode{Mistake::ends_frame_for_another_time, "other_time"},
    MistakeCode{Mistake::releases_image_without_wait, "release_without_wait"},
    MistakeCode{Mistake::keeps_image, "image_not_released"},
    MistakeCode{Mistake::never_locates_views, "views_not_located"},
    MistakeCode{Mistake::exchanges_eyes, "other_view"},
    MistakeCode{Mistake::shows_more_than_the_image, "rect_outside"},
    MistakeCode{Mistake::asks_for_another_format, "format_not_offered"},
    MistakeCode{Mistake::attaches_twice, "attached_twice"},
    MistakeCode{Mistake::suggests_late, "suggested_late"},
    MistakeCode{Mistake::reads_before_sync, "state_before_sync"},
    MistakeCode{Mistake::forgets_a_type, "wrong_type"},
    MistakeCode{Mistake::leaves_while_running, "destroyed_while_running"},
};

/// Runs it to its end; calls that fail are passed over, as a careless program does.
/// @param context current
void run_client(const stereo::EglHandles& context, Mistake mistake);

} // namespace isochron::played
