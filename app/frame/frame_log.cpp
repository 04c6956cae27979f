// A log of all frames, and its summary as text and JSON.
#include "app/frame/frame_log.h"

#include "app/frame/late_frame.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::app {
namespace {

constexpr std::array kFootprints{render::Footprint::quad, render::Footprint::gaussian,
                                 render::Footprint::mesh, render::Footprint::surface};

nlohmann::json summary_json(const TimeSummary& summary) {
    return {{"median", summary.median}, {"p99", summary.p99}, {"worst", summary.worst}};
}

} // namespace

void FrameLog::report_to(const std::filesystem::path& file) {
    rows_.emplace(file);
    told_ = next();
}

void FrameLog::add(const FrameReport& frame) {
    frames_.push_back(frame);
    if (frames_.size() > kWhole)
        frames_.pop_front();
    times_.push_back(times_of(frame));
    if (times_.size() > kTenMinutes) {
        times_.pop_front();
        ++dropped_;
    }
    for (std::size_t i = 0; i < kFrameStages.size(); ++i)
        if (belongs(times_.back(), i))
            tallies_[i].add(times_.back().stages[i]);
    if (frame.pose_age)
        ages_.add(frame.pose_age->count());
    count(frame);
    tell_rows(kOpen);
    constexpr std::size_t kShown = 120;
    if (frame.redrawn)
        speed_ = {stage(&FrameReport::total, kShown), frames_per_second(kShown)};
}

void FrameLog::count(const FrameReport& frame) {
    missed_ += frame.missed;
    ++footprints_[static_cast<std::size_t>(frame.footprint)];
    uploaded_ += frame.uploaded;
    const bool moves = frame.pace == interaction::Pace::moving;
    if (moves && frame.redrawn && frame.cells > 0) {
        ++moving_.frames;
        moving_.as_surface += render::has_layers(frame.footprint);
        moving_.slower += frame.slower;
    }
    if (is_late(frame)) {
        ++late_.over_two;
        late_.over_three += frame.total > (kLate + 1) * due_time(frame);
        ++late_.stages[longest_stage(frame)];
    }
    if (moves || frame.cells == 0) {
        moved_ = frame.time;
        resting_ = false;
        return;
    }
    rests_.count += !resting_ && moved_;
    resting_ = true;
    if (frame.after_wait) // the rest had ended as it was: what comes now comes of something else
        moved_.reset();
    if (!moved_ || !frame.redrawn || frame.footprint != render::kBestFootprint)
        return;
    ++rests_.exact;
    rests_.exact_after.add(Milliseconds(frame.time - *moved_ + frame.total).count());
    moved_.reset();
}

/// Leaves the rows of some frames for later, as their GPU times may still come.
void FrameLog::tell_rows(std::uint64_t left) {
    if (!rows_)
        return;
    const std::uint64_t first = next() - frames_.size();
    for (; told_ + left < next(); ++told_)
        rows_->add(frames_[told_ - first]);
}

void FrameLog::set_gpu(std::uint64_t frame, Milliseconds time) {
    if (frame < dropped_ || frame >= next())
        return;
    times_[frame - dropped_].gpu = time.count();
    gpu_.add(time.count());
    const std::uint64_t first = next() - frames_.size();
    if (frame >= first)
        frames_[frame - first].gpu = time;
}

FrameLog::Times FrameLog::times_of(const FrameReport& frame) {
    Times times{.at = frame.time.count(), .redrawn = frame.redrawn, .after_wait = frame.after_wait};
    for (std::size_t i = 0; i < kFrameStages.size(); ++i)
        times.stages[i] = (frame.*kFrameStages[i].second).count();
    if (frame.pose_age)
        times.pose_age = frame.pose_age->count();
    if (frame.gpu)
        times.gpu = frame.gpu->count();
    return times;
}

/// Whether a frame's time of a stage says how long the stage takes.
bool FrameLog::belongs(const Times& times, std::size_t stage) {
    return times.redrawn || kFrameStages[stage].second != FrameStage(&FrameReport::draw);
}

TimeSummary FrameLog::known(FrameSometimes time) const {
    const bool of_gpu = time == FrameSometimes(&FrameReport::gpu);
    if (dropped_ > 0)
        return (of_gpu ? gpu_ : ages_).summary();
    std::vector<double> all;
    for (const Times& times : times_)
        if (const double each = of_gpu ? times.gpu : times.pose_age; !std::isnan(each))
            all.push_back(each);
    return summarize(std::move(all));
}

TimeSummary FrameLog::stage(FrameStage stage, std::size_t count) const {
    const auto found =
        std::ranges::find(kFrameStages, stage, &std::pair<const char*, FrameStage>::second);
    const auto number = static_cast<std::size_t>(found - kFrameStages.begin());
    if (count == 0 && dropped_ > 0)
        return tallies_[number].summary();
    const std::size_t first = count == 0 || count > times_.size() ? 0 : times_.size() - count;
    std::vector<double> all;
    for (std::size_t i = first; i < times_.size(); ++i)
        if (belongs(times_[i], number))
            all.push_back(times_[i].stages[number]);
    return summarize(std::move(all));
}

double FrameLog::frames_per_second(std::size_t count) const {
    double span = 0;
    std::size_t intervals = 0;
    for (std::size_t i = times_.size() - std::min(count, times_.size()); i + 1 < times_.size();
         ++i) {
        if (times_[i + 1].after_wait)
            continue;
        span += times_[i + 1].at - times_[i].at;
        ++intervals;
    }
    return span > 0 ? static_cast<double>(intervals) / span : 0;
}

void FrameLog::finish_report(const std::string& context, const index::ReadUse& reading) {
    nlohmann::json report{{"context", context}, {"frames", next()}};
    for (const auto& [name, member] : kFrameStages)
        report["milliseconds"][name] = summary_json(stage(member));
    for (const auto& [name, member] : kFrameSometimes)
        report["milliseconds"][name] = summary_json(known(member));
    report["missed"] = missed();
    for (const render::Footprint footprint : kFootprints)
        report["footprints"][name_of(footprint)] = frames_with(footprint);
    report["moving"] = {
        {"frames", moving_.frames}, {"as_surface", moving_.as_surface}, {"slower", moving_.slower}};
    report["rests"] = {{"count", rests_.count},
                       {"exact", rests_.exact},
                       {"exact_after", summary_json(rests_.exact_after.summary())}};
    report["late"] = {{"over_two_budgets", late_.over_two},
                      {"over_three_budgets", late_.over_three},
                      {"stages", late_.stages}};
    report["uploaded"] = json_of(uploaded_);
    report["reading"] = {{"bytes", reading.bytes},
                         {"hits", reading.hits},
                         {"misses", reading.misses},
                         {"held", reading.held},
                         {"budget", reading.budget}};
    tell_rows(0);
    rows_->finish(report);
    rows_.reset();
}

std::string FrameLog::table() const {
    std::string text =
        fmt::format("{} frames{:>15} {:>8} {:>8}  [ms]\n", next(), "median", "p99", "worst");
    const auto line = [&](const char* name, const TimeSummary& summary) {
        text += fmt::format("  {:<14}{:>8.2f} {:>8.2f} {:>8.2f}\n", name, summary.median,
                            summary.p99, summary.worst);
    };
    for (const auto& [name, member] : kFrameStages)
        line(name, stage(member));
    for (const auto& [name, member] : kFrameSometimes)
        line(name, known(member));
    for (const render::Footprint footprint : kFootprints)
        text += fmt::format("  {:<14}{:>8} frames\n", name_of(footprint), frames_with(footprint));
    text += fmt::format("  {:<14}{:>8} refreshes of the display\n", "missed", missed());
    if (const Late& all = late_; all.over_two > 0) {
        text += fmt::format("  {:<14}{:>8} frames over two budgets, {} over three:", "late",
                            all.over_two, all.over_three);
        for (const auto& [stage, frames] : all.stages)
            text += fmt::format(" {} {}", stage, frames);
        text += "\n";
    }
    if (const Moving& all = moving_; all.frames > 0)
        text += fmt::format("  {:<14}{:>8} frames, {:.0f} % of them as mesh or surface\n", "moving",
                            all.frames, 100.0 * double(all.as_surface) / double(all.frames));
    if (const Rests& still = rests_; still.count > 0) {
        const TimeSummary after = still.exact_after.summary();
        text +=
            fmt::format("  {:<14}{:>8} times, {} of them exact after {:.0f} ms (worst {:.0f})\n",
                        "at rest", still.count, still.exact, after.median, after.worst);
    }
    const render::UploadCount& sent = uploaded_;
    if (sent.whole_ids > 0)
        text +=
            fmt::format("  {} sets uploaded {}: {} bytes, and {} bytes of the volume\n", sent.sets,
                        sent.ids == sent.whole_ids
                            ? "whole"
                            : fmt::format("with {:.1f} % of their ids",
                                          100.0 * double(sent.ids) / double(sent.whole_ids)),
                        sent.id_bytes, sent.block_bytes);
    return text;
}

} // namespace isochron::app
