// What happens before a session's first picture.
#include "app/explore/loading.h"

#include "app/command_line/cancel.h"
#include "interaction/input/window_event.h"

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

/// It never waits: the work goes on between its frames.
PageWindowOptions without_pace(const Config& config,
                               std::vector<interaction::WindowEvent>& others) {
    PageWindowOptions options = page_options(config);
    options.frame_rate_limit = 1e6;
    options.others = &others;
    return options;
}

} // namespace

PreparingPage::PreparingPage(const stereo::Windows& windows, std::string name, const Config& config,
                             std::vector<interaction::WindowEvent>& others)
    : windows_(windows), name_(std::move(name)), page_(windows, without_pace(config, others)) {
    constexpr int kFrames = 3; // the layout of a new window takes some
    for (int i = 0; i < kFrames; ++i)
        look(0);
}

bool PreparingPage::look(float share) {
    // Steps of the bar: each is presented, which may wait for the display.
    constexpr float kSteps = 10;
    const float shown = std::floor(kSteps * share) / kSteps;
    const auto events = page_.frame([&](glm::ivec2 size, interaction::Seconds time) {
        page_.layer().lay_out_progress(size, name_, "preparing to draw", shown, time);
    });
    canceled_ = canceled_ || interaction::is_pressed(interaction::Key::escape, events);
    left_ = left_ || !page_.goes_on();
    windows_.drawing().make_current();
    return !canceled_ && !left_;
}

} // namespace isochron::app
