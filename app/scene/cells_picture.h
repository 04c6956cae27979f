// The picture of the cells, kept apart from the lines, marks, guides and texts that are drawn over it.
#pragma once

#include "app/scene/picture.h"
#include "render/gl/render_target.h"
#include "render/gl/view.h"
#include "render/passes/reproject_pass.h"

#include <deque>
#include <optional>
#include <span>
#include <vector>

namespace isochron::app {

/// Whether the cells of two pictures look the same, and so does the background: they differ in
/// nothing but what is drawn over them. Where light shines through the cells, lines are drawn before
/// them: then all must be the same.
bool same_cells(const Picture& a, const Picture& b);

/// A picture with the cells of another one, drawn as these are.
Picture drawn_as(Picture picture, const Picture& drawn);

/// Color and depth of the newest picture of the cells, a copy for each viewport: what only changes
/// over them is drawn without them.
class CellsPicture {
  public:
    /// @param gl outlives the pictures
    explicit CellsPicture(const render::Gl& gl) : gl_(gl) {}

    /// Keeps what has been drawn into the views of the bound framebuffer, for this picture alone.
    void keep(const Picture& picture, std::span<const render::View> views);
    /// Whether the cells of this picture are kept for all of its viewports.
    /// @param viewports that show the picture
    bool hold(const Picture& picture, std::size_t viewports) const;
    /// The picture whose cells are kept, if they can be drawn for other eyes: they have one sample
    /// in each pixel. Null: there is none.
    /// @param viewports that show it
    const Picture* movable(std::size_t viewports) const;
    /// The kept pictures for the screens of these views; the eyes or the cells may have moved
    /// since. @return by view: where its picture lies; empty: there is none
    std::vector<render::PictureWithDepth> for_screens_of(std::span<const render::View> views) const;
    /// Draws the kept cells and their background into the views of the bound framebuffer.
    /// @return false: they are not kept
    bool draw_again(const Picture& picture, std::span<const render::View> views) const;
    void forget() { picture_.reset(); }

  private:
    /// The views of a viewport, which lie in one target.
    struct Kept {
        std::vector<render::View> views;
        render::RenderTarget target;
        bool newest; ///< holds cells of `picture_`; else the target is there for the next one
    };
    std::deque<Kept>::const_iterator find(std::span<const render::View> views) const;
    void copy(GLuint from, GLuint to, std::span<const render::View> views) const;

    const render::Gl& gl_;
    std::optional<Picture> picture_;
    std::deque<Kept> kept_;
};

} // namespace isochron::app
