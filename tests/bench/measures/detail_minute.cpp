// Runs a scripted session in real time and reads its log.
#include "tests/bench/measures/detail_minute.h"

#include "app/config/shipped_configs.h"
#include "app/frame/late_frame.h"
#include "app/session/session.h"
#include "stereo/context/gl_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <set>
#include <thread>
#include <utility>

namespace isochron::bench {
namespace {

using Seconds = interaction::Seconds;

constexpr double kRound = 20, kControl = 10; ///< [s]
constexpr double kRate = 60;                 ///< [Hz]
constexpr float kSway = 0.02f;               ///< [m], in the control
constexpr float kEyeHeight = 1.6f;           ///< [m]
constexpr double kWayIn = 2.6;               ///< [m]

app::Config config_of(const MinuteOptions& options) {
    app::Config config = app::parse_config(*app::shipped_config("headless"), "headless");
    stereo::Window& window = config.installation.windows.front();
    window.size = {2 * options.picture, options.picture};
    window.stereo = stereo::StereoMode::side_by_side;
    config.quality.frame_budget_ms = options.budget_ms;
    config.rendering.frame_rate_limit = kRate;
    return config;
}

/// What somebody does at a time.
struct Script {
    double low, high;
    std::uint32_t steps;

    /// @param before the time of the frame before
    interaction::Commands commands(double time, double before) const {
        interaction::Commands commands;
        const double at = std::fmod(time, kRound);
        if (time == before)
            commands.isovalue = low;
        if (at > 3 && at < 6)
            commands.isovalue = low + (high - low) * (at - 3) / 3;
        const auto jump = [](double t) { return std::floor(4 * t); };
        if (at >= 6 && at < 8 && jump(time) != jump(before))
            commands.step = static_cast<std::uint32_t>(jump(time)) % steps;
        return commands;
    }
    double way_in(double time) const {
        const double at = std::fmod(time, kRound);
        return at > 9 && at < 16 ? kWayIn * std::sin(std::numbers::pi * (at - 9) / 7) : 0;
    }
};

interaction::InputState input_at(double time, double aside, double way) {
    interaction::InputState input;
    input.time = Seconds(time);
    interaction::DeviceState head;
    head.name = "head";
    head.pose = interaction::Pose{{static_cast<float>(aside), kEyeHeight, static_cast<float>(-way)},
                                  {1, 0, 0, 0}};
    input.devices.push_back(head);
    return input;
}

/// Frames of a kind while they are counted.
struct Counted {
    MinuteFrames frames;
    std::vector<double> redrawn;

    void add(const app::FrameReport& frame, double budget_ms) {
        const double ms = frame.total.count();
        ++frames.frames;
        frames.over_two += ms > 2 * budget_ms;
        frames.over_three += ms > 3 * budget_ms;
        if (frame.redrawn)
            redrawn.push_back(ms);
    }
    MinuteFrames summary() const {
        MinuteFrames all = frames;
        const app::TimeSummary times = app::summarize(redrawn);
        all.redrawn = redrawn.size();
        all.median_ms = times.median;
        all.worst_ms = times.worst;
        return all;
    }
};

} // namespace

Minute measure_minute(const std::shared_ptr<const index::IndexFile>& file,
                      const MinuteOptions& options, const index::Progress& progress) {
    using Clock = std::chrono::steady_clock;
    const app::Config config = config_of(options);
    const auto context =
        stereo::make_context(stereo::ContextKind::egl,
                             {.size = config.installation.windows.front().size, .vsync = false});
    app::Session session(config, file, *context);
    const Script script{options.low, options.high,
                        static_cast<std::uint32_t>(file->info().steps())};
    if (!options.report.empty())
        session.log().report_to(options.report);
    session.warm_up();
    session.frame(input_at(0, 0, 0), script.commands(0, 0), app::Waiting::never);
    const auto started = Clock::now();
    Counted scripted, control;
    std::vector<std::string> late;
    std::set<render::Footprint> drawn;
    double time = 0;    ///< of the session
    double written = 0; ///< of the script, which stands still in the control
    while (written < options.seconds) {
        time = std::chrono::duration<double>(Clock::now() - started).count() + 1e-6;
        const double at = std::fmod(time, kRound + kControl);
        const bool in_control = at >= kRound;
        const double read =
            std::floor(time / (kRound + kControl)) * kRound + std::min(at, kRound - 1e-3);
        const double had = std::exchange(written, std::max(written, read));
        progress("scripted", std::min(written / options.seconds, 1.0));
        const double sways = in_control ? kSway * std::sin(std::numbers::pi * time) : 0;
        const app::FrameReport& frame =
            session.frame(input_at(time, sways, in_control ? 0 : script.way_in(written)),
                          in_control ? interaction::Commands() : script.commands(written, had),
                          app::Waiting::never);
        (in_control ? control : scripted).add(frame, options.budget_ms);
        const bool first = frame.redrawn && drawn.insert(frame.footprint).second;
        if (frame.total.count() > 2 * options.budget_ms)
            late.push_back(fmt::format("{:.2f} s{}: {}", time, in_control ? " (control)" : "",
                                       app::what_took(frame, first)));
        std::this_thread::sleep_until(
            started + std::chrono::duration_cast<Clock::duration>(Seconds(time + 1 / kRate)));
    }
    if (!options.report.empty())
        session.log().finish_report(session.drawing(), session.reading());
    return {scripted.summary(), control.summary(), std::move(late)};
}

} // namespace isochron::bench
