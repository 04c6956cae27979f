// Opens the windows of an installation.
#include "stereo/windows.h"

#include "stereo/context/swap_group.h"
#include "stereo/nodes.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::stereo {
namespace {

ContextOptions options_of(const Window& window, int monitor, const Installation& installation,
                          const WindowOptions& options, GlContext* first) {
    const StereoMode mode = mode_of(window, installation, options.stereo);
    return {.size = window.size,
            .position = window.position,
            .title = first ? fmt::format("{}: {}", options.title, window.name) : options.title,
            .fullscreen = window.fullscreen,
            .monitor = monitor,
            .vsync = options.vsync && !first,
            .border = window.border,
            .fits = window.sized != SizeOnDesktop::exactly,
            .scales = window.sized == SizeOnDesktop::scaled,
            .stereo_buffers = upright(mode) == StereoMode::quadbuffer,
            .api = options.api,
            .share = first};
}

} // namespace

Windows::Windows(GlContext& only) : windows_{&only}, numbers_{0}, drawing_(&only) {}

bool Windows::should_close() const {
    return (room_ && room_->should_close()) || (console_ && console_->should_close()) ||
           std::ranges::any_of(windows_,
                               [](const GlContext* each) { return each->should_close(); });
}

void Windows::keep_open() const {
    for (GlContext* window : windows_)
        window->keep_open();
    for (GlContext* window : {room_, console_})
        if (window)
            window->keep_open();
}

std::vector<interaction::WindowEvent> Windows::poll_events() const {
    if (room_)
        return room_->poll_events();
    std::vector<interaction::WindowEvent> events;
    for (std::size_t i = 0; i < windows_.size(); ++i)
        for (const interaction::WindowEvent& event : windows_[i]->poll_events()) {
            events.push_back(event);
            if (auto* move = std::get_if<interaction::MouseMoveEvent>(&events.back()))
                move->window = i;
        }
    return events;
}

bool Windows::take_damage() const {
    bool damaged = false;
    const auto look = [&damaged](GlContext* window) {
        damaged = (window && window->take_damage()) || damaged;
    };
    std::ranges::for_each(windows_, look);
    look(room_);
    look(console_);
    return damaged;
}

Windows open_windows(ContextKind kind, const Installation& installation,
                     const WindowOptions& options) {
    Windows opened;
    opened.numbers_ = windows_of(installation, options.rank, options.ranks);
    const std::vector<int> monitors = monitors_of(installation, opened.numbers_);
    for (std::size_t i = 0; i < monitors.size(); ++i) {
        const Window& window = installation.windows[opened.numbers_[i]];
        GlContext* first = opened.drawing_;
        try {
            opened.owned_.push_back(
                first && !first->has_window()
                    ? offscreen_beside(*first, window.size)
                    : make_context(kind,
                                   options_of(window, monitors[i], installation, options, first)));
        } catch (const render::Error& error) {
            if (installation.windows.size() == 1)
                throw;
            throw render::Error("window {}: {}", window.name, error.what());
        }
        opened.windows_.push_back(opened.owned_.back().get());
        opened.drawing_ = opened.windows_.front();
    }
    if (options.console && opened.drawing_->has_window()) {
        ContextOptions console = options_of(*options.console, std::max(options.console->monitor, 0),
                                            installation, options, opened.drawing_);
        console.stereo_buffers = false;
        opened.owned_.push_back(make_context(kind, console));
        opened.console_ = opened.owned_.back().get();
    }
    return opened;
}

void join_swap_group(const Windows& windows) {
    for (std::size_t i = 0; i < windows.count(); ++i) {
        if (!windows[i].has_window())
            continue;
        windows[i].make_current();
        join_swap_group(windows[i].loader());
    }
    windows.drawing().make_current();
}

Windows open_room(ContextKind kind, const Installation& installation, const ContextOptions& room) {
    Windows opened;
    opened.owned_.push_back(make_context(kind, room));
    opened.drawing_ = opened.room_ = opened.owned_.front().get();
    for (const Window& window : installation.windows) {
        opened.owned_.push_back(offscreen_beside(*opened.drawing_, window.size));
        opened.numbers_.push_back(opened.windows_.size());
        opened.windows_.push_back(opened.owned_.back().get());
    }
    return opened;
}

} // namespace isochron::stereo
