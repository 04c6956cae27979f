// A film of key frames as a recording.
#include "app/loop/key_film.h"

#include "app/config/first_placement.h"
#include "app/loop/movie_maker.h"
#include "interaction/recording/key_film.h"

#include <utility>

namespace isochron::app {

interaction::Recording film_of_keys(const Session& session, interaction::RecordingHeader header,
                                    std::span<const interaction::KeyFrame> keys, double rate,
                                    bool titled) {
    const PictureNote view = session.note();
    interaction::Recording film;
    film.header = header_of_view(std::move(header), view);
    if (titled)
        film.header.start.keys.emplace(keys.begin(), keys.end());
    film.frames = frames_of(keys, {.start = session.state(),
                                   .seen = devices_of_view(view),
                                   .times = session.times(),
                                   .pivot = physical_center(session.file()->info().grid),
                                   .rate = rate,
                                   .titled = titled,
                                   .logarithmic = interaction::is_wide_range(
                                       session.file()->stats().low, session.file()->stats().high)});
    return film;
}

} // namespace isochron::app
