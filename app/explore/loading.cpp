// What happens before a session's first picture.
#include "app/explore/loading.h"

#include "app/command_line/cancel.h"
#include "interaction/input/window_event.h"

#include <thread>
#include <utility>

namespace isochron::app {

IndexOpening::IndexOpening(std::function<File()> open) {
    std::packaged_task<File()> task(std::move(open));
    file_ = task.get_future();
    std::thread(std::move(task)).detach();
}

bool IndexOpening::is_done(std::chrono::milliseconds most) const {
    return file_.wait_for(most) == std::future_status::ready;
}

PageWindowOptions page_options(const Config& config) {
    return {.ended = [] { return CancelOnSignal::received() != 0; },
            .background = config.rendering.background,
            .frame_rate_limit = config.rendering.frame_rate_limit,
            .font_scale = config.panel.font_scale};
}

Waited wait_until(const std::function<bool()>& done, const stereo::Windows& windows,
                  const std::string& name, const std::string& line, const Config& config) {
    return wait_for_data(
        windows, name, [&] { return DataProgress{.ready = done(), .line = line}; },
        page_options(config));
}

Waited say_what_is_done(const stereo::Windows& windows, const std::string& name,
                        const std::string& line, const Config& config,
                        std::vector<interaction::WindowEvent>& others) {
    constexpr int kFrames = 3; // the layout of a new window takes some
    PageWindowOptions options = page_options(config);
    options.others = &others;
    return wait_for_data(
        windows, name,
        [&line, frames = 0]() mutable {
            return DataProgress{.ready = frames++ == kFrames, .line = line};
        },
        std::move(options));
}

bool gives_up(const stereo::Windows& windows, std::vector<interaction::WindowEvent>& others) {
    const auto events = windows.poll_events();
    others.insert(others.end(), events.begin(), events.end());
    return interaction::is_pressed(interaction::Key::escape, events);
}

} // namespace isochron::app
