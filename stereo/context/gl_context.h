// A GL 4.5 core context and its window, if it has one; chosen by name, without fallback.
#pragma once

#include "interaction/input/window_event.h"
#include "interaction/pose.h"
#include "render/gl/gl.h"
#include "stereo/context/native_gl.h"
#include "stereo/context/wake.h"

#include <glm/common.hpp>
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
    bool visible = true;         ///< false: a window that is never shown
    bool border = true;          ///< whether the desktop may frame the window
    bool fits = false;           ///< no larger than the first monitor has room
    bool scales = false;         ///< `size` counts pixels of a display with 96 pixels an inch
    bool stereo_buffers = false; ///< require a left and a right buffer
    ContextApi api = ContextApi::native; ///< for making a window's context
    GlContext* share = nullptr;          ///< context whose textures the new one shares; null: none
};

/// How large a window becomes. @param size that is wanted, at a scale of 1
/// @param scale of the desktop @param room of the monitor, without the desktop's bars; 0: unknown
inline glm::ivec2 size_on_desktop(glm::ivec2 size, float scale, glm::ivec2 room) {
    constexpr float kFrame = 32.0f; // [pixel] of the window's frame and title, at a scale of 1
    const glm::ivec2 wanted(glm::round(scale * glm::vec2(size)));
    const glm::ivec2 most = room - glm::ivec2(glm::round(glm::vec2(0.25f, 1.0f) * kFrame * scale));
    return room.x <= 0 || room.y <= 0 ? wanted : glm::max(glm::min(wanted, most), 1);
}

class GlContext {
  public:
    virtual ~GlContext() = default;
    virtual void make_current() = 0;
    /// It is current on this thread no longer, so that another thread may make it current.
    virtual void leave() {}
    virtual render::GlLoader loader() const = 0;
    virtual glm::ivec2 framebuffer_size() const = 0; ///< pixels; changes when a window is resized
    virtual bool has_window() const = 0;             ///< false: nothing to present to
    virtual void present() = 0; ///< swaps a window's buffers; else does nothing
    /// Whether the window has a left and a right buffer.
    virtual bool has_stereo_buffers() const { return false; }
    /// The desktop's scale: window pixels per pixel of a display with 96 pixels per inch.
    virtual float content_scale() const { return 1.0f; }
    /// [Hz] of the display that shows the window; empty if unknown.
    virtual std::optional<double> refresh_rate() const { return std::nullopt; }
    virtual bool should_close() const = 0;
    /// Takes back the user's wish to close the window.
    virtual void keep_open() {}
    /// Makes the window cover its monitor, or returns it to its place before.
    virtual void toggle_fullscreen() {}
    virtual std::vector<interaction::WindowEvent> poll_events() = 0;
    /// Waits until there is something to poll (in any window), somebody wakes, or the time is over.
    /// It may return early. A gamepad is looked at 30 times a second.
    virtual void wait(const Wake& wake, interaction::Seconds longest);
    /// Whether the window system has lost what the window showed since the last call.
    virtual bool take_damage() { return false; }
    /// Gives a text to the window system's clipboard; without a window, to nobody.
    virtual void set_clipboard(const std::string&) {}
    /// Files that were dropped onto the window since the last call.
    virtual std::vector<std::filesystem::path> take_dropped() { return {}; }
    /// The window system's handles of the context.
    virtual NativeGl native() const { return {}; }
    virtual std::string description() const = 0; ///< `GLFW, OpenGL 4.5, llvmpipe (...)`
};

/// Creates a context and makes it current. If it shares another context's textures, that one stays
/// current and must outlive it.
/// @throws render::Error in one line: what is missing, and the other kinds of contexts
std::unique_ptr<GlContext> make_context(ContextKind kind, const ContextOptions& options);

/// A context without a window that stands for another picture with its own size: it uses `drawing`,
/// which must outlive it.
std::unique_ptr<GlContext> offscreen_beside(GlContext& drawing, glm::ivec2 size);

} // namespace isochron::stereo
