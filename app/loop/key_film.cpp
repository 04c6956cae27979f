// A film of key frames as a recording.
#include "app/loop/key_film.h"

#include "app/config/first_placement.h"
#include "app/loop/movie_maker.h"
#include "interaction/recording/key_film.h"

#include <utility>

namespace isochron::app {
namespace {

/// A range of values so wide that equal factors, not equal differences, look alike.
bool is_wide(const index::IndexStats& stats) {
    constexpr double kWide = 1000;
    return stats.low > 0 && stats.high > kWide * stats.low;
}

} // namespace

interaction::Recording film_of_keys(const Session& session, interaction::RecordingHeader header,
                                    std::span<const interaction::KeyFrame> keys, double rate) {
    const PictureNote view = session.note();
    interaction::Recording film;
    film.header = header_of_view(std::move(header), view);
    film.frames = frames_of(keys, {.start = session.state(),
                                   .seen = devices_of_view(view),
                                   .times = session.times(),
                                   .pivot = physical_center(session.file()->info().grid),
                                   .rate = rate,
                                   .logarithmic = is_wide(session.file()->stats())});
    return film;
}

} // namespace isochron::app
