// The open windows of an installation: one context draws, the others show.
//
//     Windows windows = open_windows(ContextKind::glfw, installation, {.title = "CAVE"});
//     const render::Gl gl(windows.drawing().loader());
#pragma once

#include "stereo/context/gl_context.h"
#include "stereo/installation.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::stereo {

/// Everything is drawn in the one context `drawing()`: vertex arrays and framebuffers are not
/// shared between contexts, and switching between them costs. The windows' contexts are only
/// presented to.
class Windows {
  public:
    /// The caller's one context, which outlives this, for an installation of one window.
    Windows(GlContext& only); // NOLINT: a context is a set of one window

    GlContext& drawing() const { return *drawing_; }
    std::size_t count() const { return windows_.size(); }
    GlContext& operator[](std::size_t window) const { return *windows_[window]; }
    /// Which of the installation's windows it is.
    std::size_t number(std::size_t window) const { return numbers_[window]; }
    /// The desktop window that shows the room of an emulated installation; null where the
    /// installation's windows are real. Then it draws, and they are pictures beside it.
    GlContext* room() const { return room_; }
    /// The operator's window, which shows no part of the installation; null without one. Its events
    /// are not among those of `poll_events`.
    GlContext* console() const { return console_; }
    /// The window that the operator's panel lies over: the room's, or else the first.
    GlContext& first() const { return room_ ? *room_ : *windows_.front(); }

    bool should_close() const; ///< any of them
    void keep_open() const;    ///< none wants to close any longer
    /// Of all windows. Mouse positions are fractions of the window that the mouse is in.
    std::vector<interaction::WindowEvent> poll_events() const;

  private:
    Windows() = default;
    friend Windows open_windows(ContextKind, const Installation&, const struct WindowOptions&);
    friend Windows open_room(ContextKind, const Installation&, const ContextOptions&);

    std::vector<std::unique_ptr<GlContext>> owned_; ///< the drawing one first
    std::vector<GlContext*> windows_;
    std::vector<std::size_t> numbers_;
    GlContext* drawing_ = nullptr;
    GlContext* room_ = nullptr;
    GlContext* console_ = nullptr;
};

struct WindowOptions {
    std::string title = "Isochron"; ///< further windows add their name
    bool vsync = true;              ///< the first window's; the others are shown right after it
    StereoMode stereo{};            ///< that the first window starts in
    ContextApi api = ContextApi::native;          ///< that makes the windows' contexts
    std::optional<Window> console = std::nullopt; ///< beside the windows, where there is a desktop
    int rank = 0, ranks = 1;                      ///< whose windows are opened: see nodes.h
};

/// Opens every window of this process; without a window system (`egl`, `osmesa`) each is a picture
/// in one context.
/// @throws render::Error naming the window
Windows open_windows(ContextKind kind, const Installation& installation,
                     const WindowOptions& options);

/// Lets the driver swap the windows at once, with those of other processes: see swap_group.h.
/// Windows that are pictures only have no part in it. @throws render::Error
void join_swap_group(const Windows& windows);

/// Opens one window that shows the room, beside which the installation's windows are pictures.
Windows open_room(ContextKind kind, const Installation& installation, const ContextOptions& room);

} // namespace isochron::stereo
