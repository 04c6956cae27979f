// A GL 4.5 core context and, where there is one, its window; chosen by name, never by fallback.
#pragma once

#include "interaction/window_event.h"
#include "render/gl/gl.h"
#include "stereo/context/native_gl.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::stereo {

enum class ContextKind : std::uint8_t { glfw, egl, osmesa };
std::string_view name_of(ContextKind kind);
std::optional<ContextKind> context_kind_from_name(std::string_view name);

class GlContext;

struct ContextOptions {
    glm::ivec2 size{1280, 720};
    glm::ivec2 position{-1};
    std::string title = "Isochron";
    bool fullscreen = false;
    int monitor = 0;
    bool vsync = true;
    bool border = true;                  ///< whether the desktop may frame the window
    bool stereo_buffers = false;         ///< a left and a right buffer, or no window at all
    ContextApi api = ContextApi::native; ///< that makes a window's context
    GlContext* share = nullptr;          ///< a window whose textures this one's context shares
};

class GlContext {
  public:
    virtual ~GlContext() = default;
    virtual void make_current() = 0;
    virtual render::GlLoader loader() const = 0;
    virtual glm::ivec2 framebuffer_size() const = 0; ///< pixels; changes when a window is resized
    virtual bool has_window() const = 0;             ///< false: nothing to present to
    virtual void present() = 0; ///< swaps a window's buffers; else does nothing
    /// Whether the window has a left and a right buffer.
    virtual bool has_stereo_buffers() const { return false; }
    /// Pixels for each of a plain display's 96 to the inch, as the desktop has it set.
    virtual float content_scale() const { return 1.0f; }
    /// [Hz] of the display that shows the window; empty where nothing tells it.
    virtual std::optional<double> refresh_rate() const { return std::nullopt; }
    virtual bool should_close() const = 0;
    /// The user changed their mind: the window no longer wants to close.
    virtual void keep_open() {}
    /// Covers the monitor that the window is on, or goes back to where it was.
    virtual void toggle_fullscreen() {}
    virtual std::vector<interaction::WindowEvent> poll_events() = 0;
    /// Files that were dropped onto the window since the last call.
    virtual std::vector<std::filesystem::path> take_dropped() { return {}; }
    /// The context as the window system knows it.
    virtual NativeGl native() const { return {}; }
    virtual std::string description() const = 0; ///< `GLFW, OpenGL 4.5, llvmpipe (...)`
};

/// Creates a context and makes it current; one that shares another's textures leaves that one
/// current, and must not outlive it. @throws render::Error in one line: what is missing and which
/// other kinds there are
std::unique_ptr<GlContext> make_context(ContextKind kind, const ContextOptions& options);

/// One more picture of a size of its own, drawn off screen in another context, which outlives it.
std::unique_ptr<GlContext> offscreen_beside(GlContext& drawing, glm::ivec2 size);

} // namespace isochron::stereo
