// Compares pictures around steps.
#include "tests/bench/motion/step_jumps.h"

#include "app/config/config.h"
#include "app/session/session.h"
#include "index/error.h"
#include "interaction/step_track.h"
#include "stereo/context/gl_context.h"
#include "tests/bench/measures/timing.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace isochron::bench {
namespace {

using index::Instant;

constexpr std::size_t kMostSteps = 4; ///< that are looked at
constexpr int kAround = 6;            ///< pictures before a step and after it

/// Sum of the differences of all colors.
double change_between(const render::Image& a, const render::Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    return sum;
}

/// Exact pictures of moments, seen from where the explorer begins.
class Pictures {
  public:
    Pictures(const std::shared_ptr<const index::IndexFile>& file, std::optional<double> isovalue)
        : context_(stereo::make_context(stereo::ContextKind::egl, {.size = {512, 512}})),
          session_(config(), file, *context_), isovalue_(isovalue) {}

    render::Image at(Instant at) {
        constexpr int kMostFrames = 200;
        interaction::Commands commands;
        commands.between = interaction::BetweenSteps::blend;
        commands.bounding_box = false;
        commands.isovalue = isovalue_;
        commands.instant = at;
        for (int i = 0; i < kMostFrames; ++i) {
            interaction::InputState input;
            input.time = interaction::Seconds(now_ += 0.1);
            interaction::DeviceState head;
            head.name = "head";
            head.pose = interaction::Pose{{0.0f, 1.5f, 0.0f}, {1, 0, 0, 0}};
            input.devices.push_back(head);
            const app::FrameReport& frame =
                session_.frame(input, commands, app::Waiting::for_cells);
            commands = {};
            if (frame.final && frame.shown && frame.shown->instant == at)
                return session_.outputs().display().read_eye(stereo::Eye::center);
        }
        throw index::Error("step {} + {}: no final picture after {} frames", at.step, at.fraction,
                           kMostFrames);
    }

  private:
    static app::Config config() {
        app::Config config = app::read_config("headless");
        config.installation.windows.front().size = {512, 512};
        config.installation.windows.front().stereo = stereo::StereoMode::mono;
        config.quality.settled = render::Footprint::surface;
        config.quality.longest_ms = 0;
        config.quality.least_resolution = 1;
        return config;
    }

    std::unique_ptr<stereo::GlContext> context_;
    app::Session session_;
    std::optional<double> isovalue_;
    double now_ = 0;
};

} // namespace

StepJumps jumps_at_steps(const std::shared_ptr<const index::IndexFile>& file,
                         std::optional<double> isovalue, const std::function<void()>& check) {
    constexpr double kFrameSeconds = 1.0 / 60, kSlower = 10;
    const std::size_t steps = file->info().steps();
    if (steps < 3)
        throw index::Error("{}: {} steps, expected 3 or more to play over one of them",
                           file->name(), steps);
    StepJumps jumps;
    jumps.frames_of_step =
        kSlower * interaction::kRoundSeconds / kFrameSeconds / static_cast<double>(steps);
    const double each = Instant::kFractions / std::max(jumps.frames_of_step, 2.0 * kAround);
    Pictures pictures(file, isovalue);
    std::vector<double> ratios;
    const std::size_t inner = steps - 2, count = std::min(inner, kMostSteps);
    for (std::size_t i = 0; i < count; ++i) {
        const auto step = static_cast<std::uint32_t>(1 + (2 * i + 1) * inner / (2 * count));
        std::vector<double> changes;
        render::Image before;
        for (int k = -kAround; k <= kAround; ++k) {
            check();
            const auto number = static_cast<std::uint64_t>(
                std::llround(static_cast<double>(Instant(step).number()) + k * each));
            render::Image after =
                pictures.at({static_cast<std::uint32_t>(number / Instant::kFractions),
                             static_cast<std::uint32_t>(number % Instant::kFractions)});
            if (k > -kAround)
                changes.push_back(change_between(before, after));
            before = std::move(after);
        }
        const double into = changes[kAround - 1], out_of = changes[kAround];
        ratios.push_back(std::max(into, out_of) / median(changes));
    }
    jumps.steps = ratios.size();
    jumps.worst = std::ranges::max(ratios);
    jumps.median = median(ratios);
    return jumps;
}

} // namespace isochron::bench
