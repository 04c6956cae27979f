// Messages that the processes of a cluster exchange in a frame, coded as CBOR.
#include "app/cluster/cluster_messages.h"

#include "index/json_mistake.h"

#include "app/cluster/cbor_nesting.h"
#include "app/frame/cell_resolutions.h"
#include "interaction/recording/commands_json.h"
#include "interaction/recording/json_values.h"
#include "interaction/recording/recording_json.h"

#include <limits>

namespace isochron::app {
namespace {

using interaction::boolean;
using interaction::Members;
using interaction::natural;
using interaction::number;
using nlohmann::json;

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
constexpr std::size_t kMostSamples = 4096; ///< samples of one frame
constexpr std::size_t kMostRegions = 16 * 16 * 16;
constexpr int kLevelZero = 128;

json decoded(std::span<const std::byte> bytes) {
    expect_shallow_cbor(bytes); // the library recurses
    const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
    try {
        return json::from_cbor(first, first + bytes.size());
    } catch (const json::exception& error) {
        throw interaction::Error("message: expected CBOR: {}", index::json_mistake(error));
    }
}

MessageBytes bytes_of(const json& value) {
    return json::to_cbor(value);
}

std::uint64_t count(Members& members, const char* key) {
    return natural(members.at(key), key, kMost);
}

render::Footprint footprint_from(const json& value) {
    return static_cast<render::Footprint>(natural(value, "footprint", render::kFootprints - 1));
}

json cells_json(const CellOrder& cells) {
    return {{"ask", cells.ask}, {"stage", cells.stage}, {"show", cells.show}};
}

CellOrder order_from(const json& value) {
    Members members(value, "cells");
    const CellOrder order{count(members, "ask"), count(members, "stage"), count(members, "show")};
    members.done({"ask", "stage", "show"});
    return order;
}

json cells_json(const CellProgress& cells) {
    return {{"asked", cells.asked},
            {"found", cells.found},
            {"failed", cells.failed},
            {"staged", cells.staged}};
}

CellProgress progress_from(const json& value) {
    Members members(value, "cells");
    const CellProgress progress{count(members, "asked"), count(members, "found"),
                                count(members, "failed"), count(members, "staged")};
    members.done({"asked", "found", "failed", "staged"});
    return progress;
}

json load_json(const DrawLoad& load) {
    return {load.cells, load.pixels};
}

DrawLoad load_from(const json& value) {
    interaction::list(value, "load", 2, 2);
    return {number(value[0], "load"), number(value[1], "load")};
}

std::size_t resolution_from(const json& value) {
    return natural(value, "resolution", static_cast<unsigned>(kCellResolutions.size() - 1));
}

json sample_json(const DrawSample& sample) {
    json result{{"frame", sample.frame},
                {"footprint", sample.footprint},
                {"load", load_json(sample.load)},
                {"processor", sample.processor.count()},
                {"resolution", sample.resolution}};
    if (sample.gpu)
        result["gpu"] = sample.gpu->count();
    return result;
}

DrawSample sample_from(const json& value) {
    Members members(value, "sample");
    DrawSample sample;
    sample.frame = count(members, "frame");
    sample.footprint = footprint_from(members.at("footprint"));
    sample.load = load_from(members.at("load"));
    sample.processor = Milliseconds(number(members.at("processor"), "processor"));
    sample.resolution = resolution_from(members.at("resolution"));
    if (const json* gpu = members.find("gpu"))
        sample.gpu = Milliseconds(number(*gpu, "gpu"));
    members.done({"frame", "footprint", "load", "processor", "resolution", "gpu"});
    return sample;
}

json state_json(const PictureState& state) {
    json value{
        {"shown", state.shown()}, {"beside", state.beside()}, {"whole", state.parts_are_whole()}};
    if (const auto parts = state.in_parts())
        value["in_parts"] = *parts;
    return value;
}

PictureState state_from(const json& value) {
    Members members(value, "state");
    const auto shown = static_cast<Shown>(natural(members.at("shown"), "shown", kShown - 1));
    const auto beside = static_cast<Beside>(natural(members.at("beside"), "beside", kBeside - 1));
    const json* parts = members.find("in_parts");
    const auto state =
        PictureState::of(shown, beside, parts ? footprint_from(*parts) : render::Footprint{},
                         boolean(members.at("whole"), "whole"));
    if (!state || (parts != nullptr) != state->in_parts().has_value())
        throw interaction::Error("state: expected one of the table, got {} beside {}",
                                 name_of(beside), name_of(shown));
    members.done({"shown", "beside", "whole", "in_parts"});
    return *state;
}

/// Levels are sent as numbers from 0.
json detail_json(const index::DetailQuery& detail) {
    json levels = json::array();
    for (const std::int8_t level : detail.wished)
        levels.push_back(level + kLevelZero);
    return {{"most_cells", detail.most_cells},
            {"at_rest", detail.at_rest},
            {"levels", std::move(levels)}};
}

index::DetailQuery detail_from(const json& value) {
    Members members(value, "detail");
    index::DetailQuery detail{
        count(members, "most_cells"), boolean(members.at("at_rest"), "at_rest"), {}};
    for (const json& level : interaction::list(members.at("levels"), "levels", 0, kMostRegions))
        detail.wished.push_back(
            static_cast<std::int8_t>(static_cast<int>(natural(level, "levels", 255)) - kLevelZero));
    members.done({"most_cells", "at_rest", "levels"});
    return detail;
}

} // namespace

MessageBytes encoded(const FrameOrder& order) {
    const interaction::RecordedFrame frame{order.input, order.commands, {}, {}, order.latched};
    return bytes_of({{"frame", to_json(frame, nullptr)},
                     {"waits", order.waiting == Waiting::for_cells},
                     {"cells", cells_json(order.cells)}});
}

MessageBytes encoded_end() {
    return bytes_of(nullptr);
}

std::optional<FrameOrder> decode_order(std::span<const std::byte> bytes) {
    const json value = decoded(bytes);
    if (value.is_null())
        return std::nullopt;
    Members members(value, "order");
    interaction::RecordedFrame frame = interaction::frame_from_json(members.at("frame"), nullptr);
    FrameOrder order{std::move(frame.input), std::move(frame.commands),
                     boolean(members.at("waits"), "waits") ? Waiting::for_cells : Waiting::never,
                     order_from(members.at("cells")), std::move(frame.latched)};
    members.done({"frame", "waits", "cells"});
    return order;
}

MessageBytes encoded(const FramePlan& plan) {
    return bytes_of({{"footprint", plan.footprint},
                     {"reason", plan.reason},
                     {"state", state_json(plan.state)},
                     {"mesh", plan.mesh},
                     {"detail", detail_json(plan.detail)},
                     {"finer_in_parts", plan.finer_in_parts},
                     {"all_at_rest", plan.all_at_rest},
                     {"moves_finest", plan.moves_finest},
                     {"resolution", plan.resolution},
                     {"mesh_level", plan.mesh_level}});
}

FramePlan decode_plan(std::span<const std::byte> bytes) {
    const json value = decoded(bytes);
    Members members(value, "plan");
    const FramePlan plan{
        footprint_from(members.at("footprint")),
        static_cast<QualityReason>(natural(members.at("reason"), "reason",
                                           static_cast<unsigned>(QualityReason::over_budget))),
        state_from(members.at("state")),
        boolean(members.at("mesh"), "mesh"),
        detail_from(members.at("detail")),
        boolean(members.at("finer_in_parts"), "finer_in_parts"),
        boolean(members.at("all_at_rest"), "all_at_rest"),
        boolean(members.at("moves_finest"), "moves_finest"),
        resolution_from(members.at("resolution")),
        natural(members.at("mesh_level"), "mesh_level", index::kMeshLevels - 1)};
    members.done({"footprint", "reason", "state", "mesh", "detail", "finer_in_parts", "all_at_rest",
                  "moves_finest", "resolution", "mesh_level"});
    return plan;
}

MessageBytes encoded(const FrameAnswer& answer) {
    json samples = json::array();
    for (const DrawSample& sample : answer.samples)
        samples.push_back(sample_json(sample));
    return bytes_of({{"cells", cells_json(answer.cells)},
                     {"close", answer.close},
                     {"failure", answer.failure},
                     {"view", load_json(answer.view)},
                     {"surface_limit", answer.surface_limit},
                     {"parts_whole", answer.parts_whole},
                     {"parts_took", answer.parts_took.count()},
                     {"samples", std::move(samples)}});
}

FrameAnswer decode_answer(std::span<const std::byte> bytes) {
    const json value = decoded(bytes);
    Members members(value, "answer");
    FrameAnswer answer{.cells = progress_from(members.at("cells")),
                       .close = boolean(members.at("close"), "close"),
                       .failure = interaction::text(members.at("failure"), "failure"),
                       .view = load_from(members.at("view")),
                       .surface_limit = count(members, "surface_limit"),
                       .parts_whole = boolean(members.at("parts_whole"), "parts_whole"),
                       .parts_took = Milliseconds(number(members.at("parts_took"), "parts_took")),
                       .samples = {}};
    for (const json& sample : interaction::list(members.at("samples"), "samples", 0, kMostSamples))
        answer.samples.push_back(sample_from(sample));
    members.done({"cells", "close", "failure", "view", "surface_limit", "parts_whole", "parts_took",
                  "samples"});
    return answer;
}

} // namespace isochron::app
