// Runs a scripted session in real time and reads its log.
#include "tests/bench/measures/detail_minute.h"

#include "app/config/shipped_configs.h"
#include "app/session/session.h"
#include "stereo/context/gl_context.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>
#include <utility>

namespace isochron::bench {
namespace {

using Seconds = interaction::Seconds;

constexpr double kRound = 20, kRate = 60; ///< [s], [Hz]
constexpr float kEyeHeight = 1.6f;        ///< [m]
constexpr double kWayIn = 2.6;            ///< [m]

app::Config config_of(const MinuteOptions& options) {
    app::Config config = app::parse_config(*app::shipped_config("headless"), "headless");
    stereo::Window& window = config.installation.windows.front();
    window.size = {2 * options.picture, options.picture};
    window.stereo = stereo::StereoMode::side_by_side;
    config.frame_budget_ms = options.budget_ms;
    config.frame_rate_limit = kRate;
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
    interaction::InputState input(double time) const {
        const double at = std::fmod(time, kRound);
        const double way =
            at > 9 && at < 16 ? kWayIn * std::sin(std::numbers::pi * (at - 9) / 7) : 0;
        interaction::InputState input;
        input.time = Seconds(time);
        interaction::DeviceState head;
        head.name = "head";
        head.pose = interaction::Pose{{0.0f, kEyeHeight, static_cast<float>(-way)}, {1, 0, 0, 0}};
        input.devices.push_back(head);
        return input;
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
    session.frame(script.input(0), script.commands(0, 0), app::Waiting::never);
    const auto started = Clock::now();
    Minute minute;
    std::vector<double> redrawn;
    double time = 0;
    while (time < options.seconds) {
        const double before = std::exchange(
            time, std::chrono::duration<double>(Clock::now() - started).count() + 1e-6);
        progress("scripted", time / options.seconds);
        const app::FrameReport& frame =
            session.frame(script.input(time), script.commands(time, before), app::Waiting::never);
        ++minute.frames;
        const double ms = frame.total.count();
        minute.over_two += ms > 2 * options.budget_ms;
        minute.over_three += ms > 3 * options.budget_ms;
        if (frame.redrawn)
            redrawn.push_back(ms);
        std::this_thread::sleep_until(
            started + std::chrono::duration_cast<Clock::duration>(Seconds(time + 1 / kRate)));
    }
    minute.redrawn = redrawn.size();
    const app::TimeSummary times = app::summarize(redrawn);
    minute.median_ms = times.median;
    minute.worst_ms = times.worst;
    if (!options.report.empty())
        session.log().write(options.report, session.drawing(), session.reading());
    return minute;
}

} // namespace isochron::bench
