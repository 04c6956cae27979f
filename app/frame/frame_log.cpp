// A log of all frames, and its summary as text and JSON.
#include "app/frame/frame_log.h"

#include "app/frame/cell_resolutions.h"
#include "app/frame/late_frame.h"
#include "app/version.h"
#include "index/system/new_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

namespace isochron::app {
namespace {

using Stage = Milliseconds FrameReport::*;
constexpr std::array<std::pair<const char*, Stage>, 9> kStages{{
    {"search", &FrameReport::search},
    {"gather", &FrameReport::gather},
    {"wait", &FrameReport::wait},
    {"upload", &FrameReport::upload},
    {"draw", &FrameReport::draw},
    {"barrier", &FrameReport::barrier},
    {"present", &FrameReport::present},
    {"total", &FrameReport::total},
    {"latency", &FrameReport::latency},
}};
/// Times that are not known for every frame.
using Sometimes = std::optional<Milliseconds> FrameReport::*;
constexpr std::array<std::pair<const char*, Sometimes>, 2> kSometimes{{
    {"gpu", &FrameReport::gpu},
    {"pose_age", &FrameReport::pose_age},
}};

constexpr std::array kFootprints{render::Footprint::quad, render::Footprint::gaussian,
                                 render::Footprint::mesh, render::Footprint::surface};

nlohmann::json time_json(const std::optional<Milliseconds>& time) {
    return time ? nlohmann::json(time->count()) : nlohmann::json();
}

nlohmann::json query_json(const index::SurfacesQuery& query) {
    nlohmann::json json{{"step", std::uint32_t{query.step}}, {"isovalue", query.isovalues.front()}};
    if (query.isovalues.size() > 1)
        json["more_isovalues"] = std::vector(query.isovalues.begin() + 1, query.isovalues.end());
    if (query.array > 0)
        json["array"] = query.array;
    if (query.coloring == index::CellColoring::value && query.colors > 0)
        json["colors"] = query.colors;
    if (query.coloring != index::CellColoring::none)
        json["coloring"] = index::kCellColoringNames[static_cast<std::size_t>(query.coloring)];
    return json;
}

nlohmann::json upload_json(const render::UploadCount& count) {
    return {{"sets", count.sets},
            {"ids", count.ids},
            {"whole_ids", count.whole_ids},
            {"id_bytes", count.id_bytes},
            {"brick_bytes", count.block_bytes},
            {"color_bytes", count.color_bytes},
            {"mesh_bytes", count.mesh_bytes},
            {"surrounding_bytes", count.surrounding_bytes}};
}

nlohmann::json summary_json(const TimeSummary& summary) {
    return {{"median", summary.median}, {"p99", summary.p99}, {"worst", summary.worst}};
}

nlohmann::json tracking_json(const std::vector<DeviceTracking>& devices) {
    nlohmann::json result;
    for (const DeviceTracking& device : devices) {
        result[device.name]["state"] = name_of(device.tracking);
        if (device.age)
            result[device.name]["age_ms"] = Milliseconds(*device.age).count();
    }
    return result;
}

} // namespace

TimeSummary summarize(std::vector<double> milliseconds) {
    if (milliseconds.empty())
        return {};
    std::sort(milliseconds.begin(), milliseconds.end());
    const std::size_t last = milliseconds.size() - 1;
    return {milliseconds[last / 2], milliseconds[last * 99 / 100], milliseconds[last]};
}

void FrameLog::add(const FrameReport& frame) {
    frames_.push_back(frame);
    for (; frames_.size() > most_; ++dropped_)
        frames_.pop_front();
    constexpr std::size_t kShown = 120;
    if (frame.redrawn)
        speed_ = {stage(&FrameReport::total, kShown), frames_per_second(kShown)};
}

void FrameLog::set_gpu(std::uint64_t frame, Milliseconds time) {
    if (frame >= dropped_ && frame < next())
        frames_[frame - dropped_].gpu = time;
}

TimeSummary FrameLog::known(Sometimes time) const {
    std::vector<double> times;
    for (const FrameReport& frame : frames_)
        if (frame.*time)
            times.push_back((frame.*time)->count());
    return summarize(std::move(times));
}

unsigned FrameLog::missed() const {
    return std::accumulate(
        frames_.begin(), frames_.end(), 0u,
        [](unsigned sum, const FrameReport& frame) { return sum + frame.missed; });
}

std::uint64_t FrameLog::frames_with(render::Footprint footprint) const {
    return static_cast<std::uint64_t>(
        std::ranges::count(frames_, footprint, &FrameReport::footprint));
}

FrameLog::Moving FrameLog::moving() const {
    Moving moving;
    for (const FrameReport& frame : frames_)
        if (frame.pace == interaction::Pace::moving && frame.redrawn && frame.cells > 0) {
            ++moving.frames;
            moving.as_surface += render::has_layers(frame.footprint);
            moving.slower += frame.slower;
        }
    return moving;
}

FrameLog::Rests FrameLog::rests() const {
    Rests rests;
    std::optional<interaction::Seconds> moved; ///< last, where no rest has come to its end since
    bool resting = false;
    for (const FrameReport& frame : frames_) {
        if (frame.pace == interaction::Pace::moving || frame.cells == 0) {
            moved = frame.time;
            resting = false;
            continue;
        }
        rests.count += !resting && moved;
        resting = true;
        if (!moved || !frame.redrawn || frame.footprint != render::kBestFootprint)
            continue;
        rests.exact_after.push_back(Milliseconds(frame.time - *moved + frame.total).count());
        moved.reset();
    }
    return rests;
}

FrameLog::Late FrameLog::late() const {
    Late late;
    for (const FrameReport& frame : frames_)
        if (is_late(frame)) {
            ++late.over_two;
            late.over_three += frame.total > (kLate + 1) * due_time(frame);
            ++late.stages[longest_stage(frame)];
        }
    return late;
}

TimeSummary FrameLog::stage(Stage stage, std::size_t count) const {
    const std::size_t first = count == 0 || count > frames_.size() ? 0 : frames_.size() - count;
    std::vector<double> times;
    for (std::size_t i = first; i < frames_.size(); ++i)
        if (stage != &FrameReport::draw || frames_[i].redrawn)
            times.push_back((frames_[i].*stage).count());
    return summarize(std::move(times));
}

double FrameLog::frames_per_second(std::size_t count) const {
    interaction::Seconds span{0};
    std::size_t intervals = 0;
    for (std::size_t i = frames_.size() - std::min(count, frames_.size()); i + 1 < frames_.size();
         ++i) {
        if (frames_[i + 1].after_wait)
            continue;
        span += frames_[i + 1].time - frames_[i].time;
        ++intervals;
    }
    return span.count() > 0 ? static_cast<double>(intervals) / span.count() : 0;
}

void FrameLog::write(const std::filesystem::path& path, const std::string& context,
                     const index::ReadUse& reading) const {
    nlohmann::json report{{"program", kProgram}, {"context", context}, {"frames", frames_.size()}};
    for (const auto& [name, member] : kStages)
        report["milliseconds"][name] = summary_json(stage(member));
    for (const auto& [name, member] : kSometimes)
        report["milliseconds"][name] = summary_json(known(member));
    report["missed"] = missed();
    for (const render::Footprint footprint : kFootprints)
        report["footprints"][name_of(footprint)] = frames_with(footprint);
    report["moving"] = {{"frames", moving().frames},
                        {"as_surface", moving().as_surface},
                        {"slower", moving().slower}};
    const Rests still = rests();
    report["rests"] = {{"count", still.count},
                       {"exact", still.exact_after.size()},
                       {"exact_after", summary_json(summarize(still.exact_after))}};
    const Late all_late = late();
    report["late"] = {{"over_two_budgets", all_late.over_two},
                      {"over_three_budgets", all_late.over_three},
                      {"stages", all_late.stages}};
    report["uploaded"] = upload_json(uploaded());
    report["reading"] = {{"bytes", reading.bytes},
                         {"hits", reading.hits},
                         {"misses", reading.misses},
                         {"held", reading.held},
                         {"budget", reading.budget}};
    nlohmann::json& rows = report["rows"] = nlohmann::json::array();
    std::array<bool, render::kFootprints> seen{};
    for (const FrameReport& frame : frames_) {
        nlohmann::json row{{"t", frame.time.count()},
                           {"asked", query_json(frame.asked)},
                           {"shown", frame.shown ? query_json(*frame.shown) : nlohmann::json()},
                           {"pace", name_of(frame.pace)},
                           {"footprint", name_of(frame.footprint)},
                           {"coarsest_level", frame.coarsest},
                           {"volume_cells", frame.volume_cells ? nlohmann::json(*frame.volume_cells)
                                                               : nlohmann::json()},
                           {"reason", name_of(frame.reason)},
                           {"budget_ms", frame.budget.count()},
                           {"resolution", kCellResolutions[frame.resolution]},
                           {"promised_ms", frame.promised.count()},
                           {"expected_ms", time_json(frame.expected)},
                           {"missed", frame.missed},
                           {"after_wait", frame.after_wait},
                           {"redrawn", frame.redrawn},
                           {"cells", frame.cells},
                           {"candidates", frame.candidates},
                           {"reused", frame.reused},
                           {"processor_ms", frame.processor.count()},
                           {"extracting", frame.extracting},
                           {"uploaded", upload_json(frame.uploaded)}};
        bool& was_seen = seen[static_cast<std::size_t>(frame.footprint)];
        const bool first = !std::exchange(was_seen, was_seen || frame.redrawn);
        if (is_late(frame))
            row["late"] = what_took(frame, first);
        if (!frame.refused.empty())
            row["refused"] = frame.refused;
        for (const auto& [name, member] : kStages)
            row[std::string(name) + "_ms"] = (frame.*member).count();
        for (const auto& [name, member] : kSometimes)
            row[std::string(name) + "_ms"] = time_json(frame.*member);
        if (frame.comfort != interaction::ComfortState{}) {
            row["fade"] = frame.comfort.fade;
            row["vignette"] = frame.comfort.vignette;
        }
        if (!frame.tracking.empty())
            row["tracking"] = tracking_json(frame.tracking);
        rows.push_back(std::move(row));
    }
    const std::string text = report.dump(1) + "\n";
    index::NewFile file(path);
    file.write_at(0, std::as_bytes(std::span(text)));
    file.commit();
}

render::UploadCount FrameLog::uploaded() const {
    render::UploadCount all;
    for (const FrameReport& frame : frames_)
        all += frame.uploaded;
    return all;
}

std::string FrameLog::table() const {
    std::string text = fmt::format("{} frames{:>15} {:>8} {:>8}  [ms]\n", frames_.size(), "median",
                                   "p99", "worst");
    const auto line = [&](const char* name, const TimeSummary& summary) {
        text += fmt::format("  {:<14}{:>8.2f} {:>8.2f} {:>8.2f}\n", name, summary.median,
                            summary.p99, summary.worst);
    };
    for (const auto& [name, member] : kStages)
        line(name, stage(member));
    for (const auto& [name, member] : kSometimes)
        line(name, known(member));
    for (const render::Footprint footprint : kFootprints)
        text += fmt::format("  {:<14}{:>8} frames\n", name_of(footprint), frames_with(footprint));
    text += fmt::format("  {:<14}{:>8} refreshes of the display\n", "missed", missed());
    if (const Late all = late(); all.over_two > 0) {
        text += fmt::format("  {:<14}{:>8} frames over two budgets, {} over three:", "late",
                            all.over_two, all.over_three);
        for (const auto& [stage, frames] : all.stages)
            text += fmt::format(" {} {}", stage, frames);
        text += "\n";
    }
    if (const Moving all = moving(); all.frames > 0)
        text += fmt::format("  {:<14}{:>8} frames, {:.0f} % of them as mesh or surface\n", "moving",
                            all.frames, 100.0 * double(all.as_surface) / double(all.frames));
    if (const Rests still = rests(); still.count > 0) {
        const TimeSummary after = summarize(still.exact_after);
        text += fmt::format(
            "  {:<14}{:>8} times, {} of them exact after {:.0f} ms (worst {:.0f})\n", "at rest",
            still.count, still.exact_after.size(), after.median, after.worst);
    }
    const render::UploadCount sent = uploaded();
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
