// Titles over the frames of a film.
#include "app/loop/film_titles.h"

#include "interaction/navigation/story.h"

#include <algorithm>
#include <cstddef>

namespace isochron::app {

std::vector<Title> titles_of(const interaction::Recording& recording) {
    constexpr double kFade = 0.5; // [s]
    const auto& frames = recording.frames;
    auto keys = recording.header.start.keys.value_or(std::vector<interaction::KeyFrame>());
    std::uint32_t told = recording.header.start.story.value_or(0);
    std::vector<Title> titles(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        keys = frames[i].commands.keys.value_or(keys);
        told = frames[i].commands.story.value_or(told);
        if (told > 0 && told <= keys.size())
            titles[i].words = interaction::title_of_key(keys[told - 1]);
    }
    const auto time = [&](std::size_t frame) { return frames[frame].input.time.count(); };
    for (std::size_t first = 0; first < frames.size();) {
        std::size_t end = first + 1; // behind the last frame that has these words
        while (end < frames.size() && titles[end].words == titles[first].words)
            ++end;
        const double begun = time(first), ends = time(std::min(end, frames.size() - 1));
        const double fade = std::min(kFade, (ends - begun) / 2);
        for (std::size_t i = first; i < end && !titles[i].words.empty(); ++i) {
            const double from_end = std::min(time(i) - begun, ends - time(i));
            titles[i].opacity =
                fade > 0 ? static_cast<float>(std::clamp(from_end / fade, 0.0, 1.0)) : 1.0f;
        }
        first = end;
    }
    return titles;
}

} // namespace isochron::app
