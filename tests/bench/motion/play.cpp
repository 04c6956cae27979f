// Plays a motion in a session.
#include "tests/bench/motion/play.h"

#include "app/frame/pacer.h"
#include "index/system/parallel.h"
#include "tests/bench/measures/timing.h"
#include "tests/bench/motion/asked_shown.h"
#include "tests/bench/motion/fixed_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

namespace isochron::bench {
namespace {

using app::FrameReport;

/// The time that the session promised for a picture.
template <class Report>
double promised_ms(const Report& report) {
    if constexpr (requires { report.promised.count(); })
        return std::max(report.budget.count(), report.promised.count());
    else
        return report.budget.count();
}

constexpr double kRestBetween = 1.5; ///< [s] most, between two motions

double load_of_machine() {
    double load = 0;
    return ::getloadavg(&load, 1) == 1 ? load : 0;
}

/// Frames of a motion while they are counted.
struct CountedMotion {
    std::size_t frames = 0, over_two = 0, over_three = 0;
    std::vector<double> worked; ///< [ms] of processor time, of the same
    std::vector<double> times;  ///< [ms] of frames that were drawn anew
    std::vector<double> cells;
    std::map<std::string, std::size_t> drawn;
    double processor = 0, total = 0;

    void add(const FrameReport& report) {
        ++frames;
        if (!report.redrawn)
            return;
        const double ms = report.total.count(), promised = promised_ms(report);
        over_two += ms > 2 * promised;
        over_three += ms > 3 * promised;
        times.push_back(ms);
        worked.push_back(report.processor.count());
        cells.push_back(static_cast<double>(report.cells));
        processor += report.processor.count();
        total += ms;
        std::string name(render::name_of(report.footprint));
        if (report.mesh_level > 0)
            name += fmt::format(" of {}", index::kClusterEdges[report.mesh_level - 1]);
        if (report.coarsest > 0)
            name += fmt::format(" {}-{}", report.finest, report.coarsest);
        ++drawn[name];
    }
    /// What most frames showed, and the next most.
    std::string footprints() const {
        std::vector<std::pair<std::size_t, std::string>> sorted;
        for (const auto& [name, count] : drawn)
            sorted.emplace_back(count, name);
        std::ranges::sort(sorted, std::greater());
        std::string text;
        for (std::size_t i = 0; i < std::min<std::size_t>(sorted.size(), 2); ++i)
            text += fmt::format("{}{} {:.0f} %", i ? ", " : "", sorted[i].second,
                                100.0 * static_cast<double>(sorted[i].first) /
                                    static_cast<double>(times.size()));
        return text;
    }
    double share(std::size_t some) const {
        return times.empty() ? 0 : static_cast<double>(some) / static_cast<double>(times.size());
    }
};

} // namespace

std::vector<double> kept_moments(const PlayOptions& options) {
    std::vector<double> moments;
    for (double at = options.every; at < options.seconds; at += options.every)
        moments.push_back(at);
    return moments;
}

std::vector<render::Image> shown_by(const app::Session& session) {
    std::vector<render::Image> pictures;
    const stereo::Display& display = session.outputs().display();
    for (const stereo::Eye eye : stereo::eyes_of(display.mode()))
        pictures.push_back(display.read_eye(eye));
    return pictures;
}

Player::Player(const app::Config& config, std::shared_ptr<const index::IndexFile> file,
               stereo::Windows windows, const PlayOptions& options, Check check)
    : config_(config), file_(file), options_(options), check_(std::move(check)),
      session_(config_, file_, std::move(windows)), pacer_(config.rendering.frame_rate_limit) {
    session_.warm_up();
}

double Player::now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

const FrameReport& Player::frame(const MotionScript& script, double at,
                                 const interaction::Commands& commands) {
    check_();
    session_.outputs().windows().poll_events();
    input_ = script.input(now(), at);
    return session_.frame(input_, commands, app::Waiting::never);
}

bool Player::is_final() const {
    const FrameReport& last = session_.log().frames().back();
    const app::FrameOutlook next = session_.outlook();
    return next.final && !next.busy && last.shown &&
           last.shown->of_cells() == last.asked.of_cells();
}

ShownPicture Player::shown(const interaction::InputState& input) const {
    ShownPicture shown{shown_by(session_), session_.state(), input, 0};
    if (const auto& cells = session_.log().frames().back().shown) {
        shown.state.instant = cells->instant;
        for (std::size_t i = 0; i < cells->isovalues.size(); ++i)
            shown.state.isosurfaces[i].isovalue = cells->isovalues[i];
    }
    return shown;
}

bool Player::settle(const app::ExplorerState& state, double longest) {
    const MotionScript script(Motion::sway, options_.seconds, state, {}, 1);
    interaction::Commands commands = state.as_commands();
    const double began = now();
    // The gate takes a moment to call the picture settled.
    constexpr double kLeast = 0.3;
    do {
        frame(script, 0, commands);
        commands = {};
        pacer_.wait();
    } while (now() < began + kLeast || (!is_final() && now() < began + longest));
    return is_final();
}

Played Player::play(Motion motion, const app::ExplorerState& start) {
    // What happened before is settled; the place alone may be new.
    settle(start, std::exchange(fresh_, false) ? options_.longest_rest : kRestBetween);
    Played played;
    const FrameReport& before = session_.log().frames().back();
    played.row.cells = before.volume_cells.value_or(before.cells);
    const MotionScript script(motion, options_.seconds, start,
                              app::physical_center(file_->info().grid), file_->info().steps());
    const std::vector<double> moments = kept_moments(options_);
    const double load = load_of_machine();
    CountedMotion counted;
    AskedShown asked;
    FixedWork control;
    double moved = 0;  ///< session time of the last frame that moved
    double paused = 0; ///< that reading pictures took
    const double began = now();
    // Where pictures come too slowly, the motion waits for those that are to be kept.
    for (double at = 0; at < options_.seconds || played.moving.size() < moments.size();) {
        // A picture is kept of the motion's moment itself, so that all budgets have the same.
        const std::size_t next = played.moving.size();
        const bool keeps = next < moments.size() && at >= moments[next];
        const double moment = keeps ? moments[next] : std::min(at, options_.seconds);
        const FrameReport& report = frame(script, moment, script.commands(moment));
        if (asks_for_cells(motion))
            asked.add(report, now());
        else
            asked.add_moved(report, now());
        counted.add(report);
        if (keeps) {
            const double reads = now();
            played.moving.push_back(shown(input_));
            played.moving.back().number = next;
            paused += now() - reads;
        }
        moved = now();
        pacer_.wait();
        at = now() - began - paused;
    }
    const double length = now() - began - paused;
    std::optional<double> exact;
    double settled = moved;
    while (!exact && now() < moved + options_.longest_rest) {
        const FrameReport& report = frame(script, options_.seconds, {});
        if (asks_for_cells(motion))
            asked.add(report, now());
        if (report.pace == interaction::Pace::moving)
            settled = report.time.count();
        if (report.pace != interaction::Pace::moving && is_final())
            exact = 1e3 * (now() - settled);
        pacer_.wait();
    }
    played.stopped = shown(input_);
    MotionRow& row = played.row;
    row.load = load;
    row.seconds = options_.seconds;
    row.motion = name_of(motion);
    row.drawn = counted.footprints();
    row.frames = counted.frames;
    row.redrawn = counted.times.size();
    row.per_second = static_cast<double>(row.redrawn) / length;
    if (row.redrawn > 0) {
        row.frame_ms = median(counted.times);
        row.drawn_cells = static_cast<std::uint64_t>(median(counted.cells));
    }
    row.over_two = counted.share(counted.over_two);
    row.over_three = counted.share(counted.over_three);
    row.busy = counted.total > 0 ? counted.processor / counted.total : 0;
    row.shown_ms = asked.percentile(50);
    row.shown_late_ms = asked.percentile(95);
    row.exact_ms = exact;
    const double promised = promised_ms(session_.log().frames().back());
    const double of_each =
        counted.worked.empty() ? 0 : median(counted.worked) / index::thread_count(0);
    const FixedWork::Late late = control.run(of_each, promised, options_.seconds / 6, check_);
    row.control_two = late.over_two;
    row.control_three = late.over_three;
    row.budget_ms = promised;
    return played;
}

} // namespace isochron::bench
