// A picture that is drawn piece by piece.
#include "app/choice/picture_in_pieces.h"

#include "app/frame/stop_watch.h"

#include <algorithm>

namespace isochron::app {

void PictureInPieces::draw(Scene& scene, Outputs& outputs, Milliseconds most) {
    pace.begin_frame(most);
    StopWatch watch;
    while (const std::size_t work = whole ? 0 : pace.next()) {
        std::size_t done_now = scene.prepare_parts(picture, work);
        if (done_now > 0) {
            outputs.gl().Finish(); // so that its time is known
            const Milliseconds time = watch.lap();
            prepared += time;
            pace.took(done_now, time);
            continue;
        }
        whole = outputs.draw_part(picture.audience, place,
                                  [&](const ScenePlace&, std::span<const render::View> views) {
                                      return draw_part(scene, views, work, done_now);
                                  });
        pace.took(done_now, watch.lap());
    }
}

/// Draws the next part of a viewport: what comes before the cells, some of the cells, or what comes
/// after them.
/// @param done_now work that was done, of at most `work` @return whether it was the last
bool PictureInPieces::draw_part(Scene& scene, std::span<const render::View> views, std::size_t work,
                                std::size_t& done_now) {
    ScenePart part{.begins = place.begins, .cells = {done, 0}, .ends = false, .keeps = keeps};
    const std::size_t all = scene.work(picture, views.size());
    if (part.begins) {
        done = 0;
    } else if (done < all) {
        part.cells.count = done_now = std::min(work, all - done);
    } else {
        part.ends = true;
    }
    done += scene.draw(picture, views, part);
    return part.ends;
}

} // namespace isochron::app
