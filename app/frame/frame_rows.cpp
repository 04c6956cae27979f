// Writing of a timing report.
#include "app/frame/frame_rows.h"

#include "app/frame/cell_resolutions.h"
#include "app/frame/frame_stages.h"
#include "app/frame/late_frame.h"
#include "app/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace isochron::app {
namespace {

constexpr std::size_t kRowsAtOnce = 64;
/// By which a report is known: see app/output/known_files.h.
std::string beginning() {
    return fmt::format("{{\n \"program\": \"{}\",\n \"rows\": [", kProgram);
}

nlohmann::json time_json(const std::optional<Milliseconds>& time) {
    return time ? nlohmann::json(time->count()) : nlohmann::json();
}

nlohmann::json query_json(const index::SurfacesQuery& query) {
    nlohmann::json json{{"step", query.instant.step}, {"isovalue", query.isovalues.front()}};
    if (query.instant.between())
        json["fraction"] = query.instant.fraction;
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

nlohmann::json json_of(const render::UploadCount& count) {
    return {{"sets", count.sets},
            {"ids", count.ids},
            {"whole_ids", count.whole_ids},
            {"id_bytes", count.id_bytes},
            {"brick_bytes", count.block_bytes},
            {"color_bytes", count.color_bytes},
            {"mesh_bytes", count.mesh_bytes},
            {"surrounding_bytes", count.surrounding_bytes}};
}

void FrameRows::add(const FrameReport& frame) {
    waiting_.push_back(frame);
    if (waiting_.size() >= kRowsAtOnce)
        write_waiting();
}

void FrameRows::finish(const nlohmann::json& summary) {
    write_waiting();
    writing_.finish();
    // The summary is an object: its members follow the rows.
    write((rows_ == 0 ? beginning() + "]," : "\n ],") + summary.dump(1).substr(1) + "\n");
    file_.commit();
}

void FrameRows::write_waiting() {
    writing_.post([this, frames = std::exchange(waiting_, {})] {
        std::string text;
        for (const FrameReport& frame : frames)
            text += (rows_++ == 0 ? beginning() + "\n  " : ",\n  ") + row_of(frame).dump();
        write(text);
        return std::string();
    });
}

void FrameRows::write(const std::string& text) {
    file_.write_at(bytes_, std::as_bytes(std::span(text)));
    bytes_ += text.size();
}

nlohmann::json FrameRows::row_of(const FrameReport& frame) {
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
                       {"moved", frame.moved},
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
                       {"uploaded", json_of(frame.uploaded)}};
    bool& was_seen = seen_[static_cast<std::size_t>(frame.footprint)];
    const bool first = !std::exchange(was_seen, was_seen || frame.redrawn);
    if (is_late(frame))
        row["late"] = what_took(frame, first);
    if (!frame.refused.empty())
        row["refused"] = frame.refused;
    for (const auto& [name, member] : kFrameStages)
        row[std::string(name) + "_ms"] = (frame.*member).count();
    for (const auto& [name, member] : kFrameSometimes)
        row[std::string(name) + "_ms"] = time_json(frame.*member);
    if (frame.comfort != interaction::ComfortState{}) {
        row["fade"] = frame.comfort.fade;
        row["vignette"] = frame.comfort.vignette;
    }
    if (!frame.tracking.empty())
        row["tracking"] = tracking_json(frame.tracking);
    return row;
}

} // namespace isochron::app
