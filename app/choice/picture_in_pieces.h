// A picture that is drawn piece by piece, over several frames, beside the one that is shown.
#pragma once

#include "app/frame/milliseconds.h"
#include "app/output/outputs.h"
#include "app/quality/part_pace.h"
#include "app/scene/scene.h"

#include <cstddef>
#include <span>

namespace isochron::app {

struct PictureInPieces {
    explicit PictureInPieces(const Picture& wanted) : picture(wanted) {}

    /// Draws pieces while this frame has time for them, or until the picture is whole.
    /// @param most time that the frame may spend
    void draw(Scene& scene, Outputs& outputs, Milliseconds most);

    Picture picture;
    PartPace pace;
    Outputs::PartPlace place;
    std::size_t done = 0;     ///< units of work done at `place`
    Milliseconds prepared{0}; ///< time spent on what serves other views, too
    bool keeps = true;        ///< its cells are kept, see `ScenePart`
    bool whole = false;

  private:
    bool draw_part(Scene& scene, std::span<const render::View> views, std::size_t work,
                   std::size_t& done_now);
};

} // namespace isochron::app
