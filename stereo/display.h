// Draws a window: every eye of every viewport, composed by the stereo mode, and presents it.
//
//     Display display(gl, *context, installation.windows.front(), {});
//     display.draw(head, 0.063f, StereoMode::side_by_side,
//                  [&](std::span<const render::View> eyes) { pass.draw(eyes); }, draw_panel);
//     display.present();
#pragma once

#include "render/gl/image.h"
#include "render/gl/render_target.h"
#include "render/passes/sample_sum.h"
#include "stereo/context/gl_context.h"
#include "stereo/display_options.h"
#include "stereo/installation.h"
#include "stereo/multiplex.h"
#include "stereo/presenter.h"
#include "stereo/screen.h"

#include <glm/vec2.hpp>

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace isochron::stereo {

/// Where a viewer's eyes are in one frame.
struct ViewerPose {
    interaction::Pose head;
    Eyes eyes; ///< in the head's frame
    /// If not 0, desktop screens show a parallel projection, the same to both eyes. At this
    /// distance [m] things are as large as in perspective.
    float parallel = 0;
    bool operator==(const ViewerPose&) const = default;
};

/// One window; an installation with several windows has one display for each.
///
/// stereo_mode.h tells how each mode places the eyes. `side_by_side` and `top_bottom` give each eye
/// half the window, with the left eye left or on top. A wall's picture is squeezed into its half,
/// for projectors and televisions that stretch each half over the whole wall. A `fit_aspect` screen
/// takes the aspect of the half, so that shapes keep their proportions on a monitor.
class Display {
  public:
    /// Called once for each of the window's viewports, in their order.
    using Scene = DrawViews;
    /// Draws over the composed window, which is bound, for example a panel; gets its size in
    /// pixels.
    /// Called for each buffer of the window: twice in a quad-buffered one, where it must draw the
    /// same both times.
    using Overlay = std::function<void(glm::ivec2)>;

    /// @param drawing the drawing context, which is current
    /// @param context the window's context, which may be the same one
    /// All, with `gl`, outlive the display.
    Display(const render::Gl& gl, GlContext& drawing, GlContext& context, Window window,
            const DisplayOptions& options);
    Display(const render::Gl& gl, GlContext& context, Window window, const DisplayOptions& options)
        : Display(gl, context, context, std::move(window), options) {}

    /// Draws one frame at the current size of the framebuffer: each eye of each viewport that the
    /// mode shows, exactly once; then the overlay. Draws nothing if the window is minimized.
    /// @param viewers by the numbers that the window's viewports use
    void draw(std::span<const ViewerPose> viewers, StereoMode mode, const Scene& scene,
              const Overlay& overlay = {});
    /// Draws for one viewer.
    void draw(const interaction::Pose& head, float eye_separation, StereoMode mode,
              const Scene& scene, const Overlay& overlay = {}) {
        const ViewerPose viewer{head, eye_separation};
        draw(std::span(&viewer, 1), mode, scene, overlay);
    }

    /// Draws a part of a viewport's next picture while the last one stays on show, with the size
    /// of the window and the stereo mode of the last frame.
    /// @param begins this is its first part
    /// @return whether it is complete, as `scene` said
    bool draw_part(std::span<const ViewerPose> viewers, std::size_t viewport, bool begins,
                   const DrawPart& scene);
    /// Shows the next pictures of all viewports, which must be complete.
    void show_parts(const Overlay& overlay);

    /// Begins the mean of several pictures of all viewports with what is shown; and ends it.
    void begin_mean();
    void end_mean() { in_mean_ = 0; }
    /// Uses once all that a mean needs.
    void prepare_mean();
    /// Pictures in the mean; 0: there is none. While there is one, each next picture is moved by so
    /// much of a pixel that it takes another sample.
    int in_mean() const { return in_mean_; }
    /// Adds the next pictures of all viewports, which must be complete.
    void add_to_mean();
    /// Makes the mean the next pictures of all viewports, to be shown by `show_parts`.
    void complete_mean();

    /// Composes the last pictures of the eyes again, with a new overlay: for frames in which
    /// nothing else has changed.
    void draw_overlay_again(const Overlay& overlay);

    /// The views of the eyes drawn last, where their pictures lie in the composed window: for what
    /// an overlay draws into the room. None where both eyes share pixels.
    std::vector<render::View> views_in_window(std::span<const ViewerPose> viewers) const;

    /// Shows the last frame; does nothing without a window.
    void present();

    /// The ray from the eye that sees a place in the window of the last frame, or from between the
    /// eyes if both see it: a pose that looks along -Z. Empty outside all viewports.
    /// @param viewers where the viewers are now
    /// @param at fractions of the window from the lower left
    std::optional<interaction::Pose> ray_at(std::span<const ViewerPose> viewers,
                                            glm::vec2 at) const;

    /// Leaves the edges of each eye's part free, for a panel, from the next drawn frame on, or from
    /// the next parts that are shown.
    void leave_free(const Margins& margins) { next_margins_ = margins; }
    /// From the next drawn frame on, the left `share` of each eye's part shows what is to the left
    /// of the screen: for a panel that stands there.
    void show_aside(float share) {
        for (Viewport& viewport : window_.viewports)
            viewport.screen.aside = share;
    }
    bool fills() const { return margins_ == Margins{}; } ///< nothing is left free

    const Window& window() const { return window_; }
    glm::ivec2 size() const { return composed_.size(); } ///< size of the last frame, pixels
    StereoMode mode() const { return mode_; }            ///< mode of the last frame

    /// The whole window in the last frame, with the overlay; the left buffer if it is
    /// quad-buffered.
    render::Image read_window() const { return composed_.read(); }
    /// The right buffer of a quad-buffered window. @throws render::Error in any other mode
    render::Image read_right_buffer() const;
    /// One eye's picture of a viewport at its own resolution, without the overlay.
    /// @throws render::Error when the last frame did not show that eye
    render::Image read_eye(Eye eye, std::size_t viewport = 0) const;
    /// Where that picture lies; valid until the next frame is drawn. @throws as `read_eye`
    EyePicture eye_picture(Eye eye, std::size_t viewport) const;
    /// Size of each eye's picture of a viewport in the last frame, pixels.
    glm::ivec2 eye_size(std::size_t viewport) const;

  private:
    /// Part of the composed window, pixels from the lower left.
    struct Region {
        glm::ivec2 corner, size;
    };

    /// Margins that stay free: in what is shown, in what is drawn next.
    Margins margins_, next_margins_;
    Region region_of(const Viewport& viewport, Eye place) const;
    render::View view_in(const Viewport& viewport, const ViewerPose& viewer, Eye eye) const;
    std::vector<render::View> views_in_target(std::size_t number, const ViewerPose& viewer) const;
    void draw_viewport(std::optional<render::RenderTarget>& target, std::size_t number,
                       const ViewerPose& viewer, const Scene& scene);
    void draw_mean(std::span<const ViewerPose> viewers, const Scene& scene);
    /// The eye's picture to show in the place of `place`.
    EyePicture shown_at(Eye place, std::size_t viewport) const;
    bool fills_window() const; ///< the eyes' regions cover every pixel of the window
    void compose(const Overlay& overlay);
    void compose_into(const render::RenderTarget& target, Eye buffer) const;

    const render::Gl* gl_;
    GlContext* context_;
    Window window_;
    DisplayOptions options_;
    Multiplex multiplex_;
    Presenter presenter_;
    StereoMode mode_ = StereoMode::mono; ///< mode of the last frame
    render::RenderTarget composed_;
    std::optional<render::RenderTarget> right_buffer_; ///< while the window is quad-buffered
    std::vector<std::optional<render::RenderTarget>> targets_; ///< by viewport, from its first draw
    /// By viewport: the next picture, drawn in parts.
    std::vector<std::optional<render::RenderTarget>> next_;
    std::vector<std::optional<render::SampleSum>> sums_; ///< by viewport, from its first mean
    int in_mean_ = 0;
};

} // namespace isochron::stereo
