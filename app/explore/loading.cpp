// What happens before a session's first picture.
#include "app/explore/loading.h"

#include "app/command_line/cancel.h"

#include <fmt/format.h>

#include <cmath>
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

namespace {

constexpr int kFramesOfLayout = 3; ///< that a new window of the panel takes

/// It never waits: the work goes on between its frames.
PageWindowOptions without_pace(const Config& config,
                               std::vector<interaction::WindowEvent>& others) {
    PageWindowOptions options = page_options(config);
    options.frame_rate_limit = 1e6;
    options.others = &others;
    return options;
}

} // namespace

void show_loading(const stereo::Windows& windows, const std::string& name, const Config& config,
                  std::vector<interaction::WindowEvent>& others, bool but_first) {
    const auto show = [&](stereo::GlContext& window) {
        if (!window.has_window() || (but_first && &window == &windows.first()))
            return;
        const stereo::Windows alone(window);
        PageWindow page(alone, without_pace(config, others));
        for (int i = 0; i < kFramesOfLayout; ++i)
            page.frame([&](glm::ivec2 size, interaction::Seconds time) {
                page.layer().lay_out_progress(size, name, "loading", 0, time);
            });
    };
    if (windows.room())
        show(*windows.room());
    for (std::size_t i = 0; i < windows.count(); ++i)
        show(windows[i]);
    windows.drawing().make_current();
}

std::string time_left(float share, interaction::Seconds elapsed) {
    constexpr float kKnown = 0.05f; // share from which on it tells something
    if (!(share >= kKnown) || share >= 1)
        return "";
    const double left = elapsed.count() * (1 - share) / share;
    return left < 1 ? ", less than 1 s" : fmt::format(", about {:.0f} s", left);
}

PreparingPage::PreparingPage(const stereo::Windows& windows, std::string name, const Config& config,
                             std::vector<interaction::WindowEvent>& others)
    : windows_(windows), name_(std::move(name)), page_(windows, without_pace(config, others)) {
    for (int i = 0; i < kFramesOfLayout; ++i)
        look(0);
}

bool PreparingPage::look(float share) {
    // Steps of the bar: each is presented, which may wait for the display.
    constexpr float kSteps = 10;
    const float shown = std::floor(kSteps * share) / kSteps;
    const std::string left = time_left(share, std::chrono::steady_clock::now() - begun_);
    const auto events = page_.frame([&](glm::ivec2 size, interaction::Seconds time) {
        page_.layer().lay_out_progress(size, name_, "preparing" + left, shown, time);
    });
    canceled_ = canceled_ || interaction::is_pressed(interaction::Key::escape, events);
    left_ = left_ || !page_.goes_on();
    windows_.drawing().make_current();
    return !canceled_ && !left_;
}

} // namespace isochron::app
