// What the first picture does not need: drawn once beside the frames, on another thread first.
#pragma once

#include "app/scene/scene.h"
#include "render/gl/render_target.h"
#include "render/gl/view.h"
#include "stereo/context/gl_context.h"
#include "stereo/display_options.h"

#include <glm/vec2.hpp>

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace isochron::app {

/// Drivers compile shaders when they are linked and first used, mostly on one core, and keep the
/// result. The first picture needs a dozen of some sixty programs. The others are used once in a
/// context of their own on a thread of its own, and then, as the driver has them at hand, in the
/// session's context between two frames. Without the other context only the latter is done.
class Preparation {
  public:
    /// Onto what it is drawn: pictures of the same kind as those of the window.
    struct Target {
        std::vector<render::View> views;
        glm::ivec2 size{1}; ///< [pixel]
        stereo::DisplayOptions options;
    };

    /// @param gl of the session @param scene draws in the ways that it lacks; outlives this
    /// @param beside current on no thread; null: there is none
    Preparation(const render::Gl& gl, Scene& scene, Target target,
                std::unique_ptr<stereo::GlContext> beside);
    ~Preparation();

    /// Sets the function that the thread calls when `advance` may have something to do.
    void set_wake(std::function<void()> wake);
    /// Draws in the next way in the session's context, if the thread is through with it.
    /// @return whether it has
    bool advance();
    bool is_done() const { return next_ == ways_.size(); }

  private:
    void draw_ahead(const std::stop_token& stop);
    void through_with(std::size_t ways);

    const render::Gl& gl_;
    Scene& scene_;
    const Target target_;
    const CellDrawing drawing_;
    const std::vector<std::size_t> ways_;
    std::unique_ptr<stereo::GlContext> beside_;
    std::optional<render::RenderTarget> picture_;
    std::size_t next_ = 0;           ///< way in which `advance` draws next
    std::atomic<std::size_t> ahead_; ///< ways that the thread is through with
    std::mutex mutex_;
    std::function<void()> wake_; ///< may be null
    std::jthread thread_;        ///< last: it uses all the others
};

} // namespace isochron::app
