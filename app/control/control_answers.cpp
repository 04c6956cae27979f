// Makes the answers and events of the control socket.
#include "app/control/control_answers.h"

#include "index/error.h"
#include "index/export/exported_step.h"
#include "index/extraction/profile.h"
#include "index/file/named_index.h"
#include "index/search/index_search.h"
#include "index/search/surface_mesh.h"
#include "interaction/recording/commands_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace isochron::app {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of_line(const Json& line) {
    return line.dump(-1, ' ', true, Json::error_handler_t::replace) + '\n';
}

/// The id and `ok` stand first.
Json answer_to(const std::string& id, bool ok) {
    return {{"id", Json::parse(id)}, {"ok", ok}};
}

Json state_of(const ShownFrame& shown) {
    return interaction::commands_json(shown.state->as_commands());
}

Json surfaces_of(const index::SurfacesQuery& query) {
    return {{"step", query.instant.step},
            {"fraction", query.instant.fraction},
            {"isovalues", query.isovalues}};
}

Json time_of(const ShownFrame& frame) {
    return {{"step", frame.state->instant.step},
            {"fraction", frame.state->instant.fraction},
            {"playing", frame.state->playback.playing}};
}

Json cells_of(const ShownFrame& frame) {
    const FrameReport& report = frame.report;
    return {{"asked", surfaces_of(report.asked)},
            {"shown", report.shown ? surfaces_of(*report.shown) : Json()},
            {"cells", report.cells},
            {"final", report.final}};
}

Json statistics_of(const ShownFrame& frame) {
    const FrameReport& report = frame.report;
    return {{"footprint", render::name_of(report.footprint)},
            {"pace", interaction::name_of(report.pace)},
            {"draw_ms", report.draw.count()},
            {"total_ms", report.total.count()},
            {"latency_ms", report.latency.count()},
            {"search_ms", report.search.count()},
            {"extracting", report.extracting}};
}

Json told(ControlTopic topic, const ShownFrame& frame) {
    switch (topic) {
    case ControlTopic::state: return state_of(frame);
    case ControlTopic::time: return time_of(frame);
    case ControlTopic::cells: return cells_of(frame);
    case ControlTopic::statistics: break;
    }
    return statistics_of(frame);
}

bool same(ControlTopic topic, const ShownFrame& a, const ShownFrame& b) {
    if (topic == ControlTopic::state)
        return a.state == b.state || *a.state == *b.state;
    return told(topic, a) == told(topic, b);
}

/// Bytes that are filled from their beginning on.
class Bytes {
  public:
    explicit Bytes(std::size_t size) : bytes_(std::make_shared<std::vector<std::byte>>(size)) {}
    template <class T>
    void put(const T& value) {
        std::memcpy(bytes_->data() + at_, &value, sizeof value);
        at_ += sizeof value;
    }
    std::shared_ptr<const std::vector<std::byte>> take() { return std::move(bytes_); }

  private:
    std::shared_ptr<std::vector<std::byte>> bytes_;
    std::size_t at_ = 0;
};

void expect_room(std::size_t bytes, const char* instead) {
    if (bytes > kLargestAnswer)
        throw index::Error("the answer has {} MiB, more than {}; {} writes it as a file",
                           bytes >> 20, kLargestAnswer >> 20, instead);
}

/// What is asked of which array.
struct Searched {
    std::shared_ptr<const index::IndexFile> array;
    index::Query query;
    Json words; ///< for the answer
};

Searched searched(const ControlRequest& request,
                  const std::shared_ptr<const index::IndexFile>& file, const ExplorerState& shown) {
    const std::string& name = request.array ? *request.array : shown.array;
    const bool of_picked =
        !request.array && !request.isovalue && request.verb != ControlVerb::profile;
    const std::size_t number = of_picked      ? array_of_surface(shown, shown.picked, *file)
                               : name.empty() ? 0
                                              : index::array_number(*file, name);
    Searched result{.array = index::array_of(file, number), .query = {}, .words = {}};
    const index::Instant at = request.step
                                  ? index::Instant(index::step_named(*result.array, *request.step))
                                  : shown.shown_instant();
    result.query = {at, request.isovalue.value_or(shown.isovalue())};
    result.words = {{"array", result.array->info().array},
                    {"step", at.step},
                    {"fraction", at.fraction},
                    {"isovalue", result.query.isovalue}};
    return result;
}

ControlAnswer with_bytes(Json line, const Json& words,
                         std::shared_ptr<const std::vector<std::byte>> bytes) {
    line.update(words);
    line["bytes"] = bytes->size();
    return {text_of_line(line), std::move(bytes)};
}

ControlAnswer cells_answer(const std::string& id, const Searched& asked,
                           const std::stop_token& stop) {
    const index::Grid& grid = asked.array->info().grid;
    const bool wide = index::has_wide_ids(grid);
    index::CellSet set;
    const auto search = index::search_into(asked.array, std::nullopt,
                                           wide ? index::Shading::cells : index::Shading::none);
    if (!search(index::step_of_query(*asked.array, asked.query.instant, {&asked.query.isovalue, 1}),
                asked.query.isovalue, stop, set))
        throw index::Stopped();
    const std::size_t cells = wide ? set.points.size() : set.ids.size();
    const std::size_t size = cells * (wide ? sizeof(std::uint64_t) : sizeof(index::CellId));
    expect_room(size, "isochron query --ids");
    Bytes bytes(size);
    if (wide)
        for (const index::CellPoint& point : set.points)
            bytes.put(index::wide_id(grid, point.x, point.y, point.z));
    else
        for (const index::CellId id_of_cell : set.ids)
            bytes.put(id_of_cell);
    Json line = answer_to(id, true);
    line["cells"] = cells;
    line["id_bits"] = wide ? 64 : 32;
    return with_bytes(std::move(line), asked.words, bytes.take());
}

ControlAnswer mesh_answer(const std::string& id, const Searched& asked,
                          const std::stop_token& stop) {
    index::SurfaceMeshes meshes(asked.array);
    const auto mesh = meshes.make_packed(asked.query, {.normals = true}, stop);
    if (!mesh)
        throw index::Stopped();
    const std::size_t points = mesh->vertices.size(), triangles = mesh->triangles.size() / 3;
    const std::size_t size = points * 6 * sizeof(float) + triangles * 3 * sizeof(std::uint32_t);
    expect_room(size, "isochron export");
    const index::ExportPlan plan;
    const index::ExportedPlaces places(asked.array->info().grid, plan);
    Bytes bytes(size);
    for (const index::MeshVertex& vertex : mesh->vertices)
        bytes.put(glm::vec3(places.of(vertex)));
    for (const index::MeshVertex& vertex : mesh->vertices)
        bytes.put(glm::vec3(normal_of(vertex)));
    for (std::size_t i = 0; i < mesh->triangles.size(); i += 3)
        bytes.put(places.triangle(
            std::array{mesh->triangles[i], mesh->triangles[i + 1], mesh->triangles[i + 2]}));
    Json line = answer_to(id, true);
    line["points"] = points;
    line["triangles"] = triangles;
    line["origin"] = {places.origin().x, places.origin().y, places.origin().z};
    line["unit"] = asked.array->info().length_unit;
    return with_bytes(std::move(line), asked.words, bytes.take());
}

ControlAnswer profile_answer(const std::string& id, const Searched& asked,
                             const std::vector<glm::dvec3>& places,
                             const interaction::Rulers& rulers, const std::stop_token& stop) {
    const interaction::Ruler* const ruler = places.empty() ? rulers.chosen() : nullptr;
    if (places.empty() && !(ruler && ruler->complete()))
        throw index::Error("profile: expected places, or a ruler that the session shows");
    const index::Profile profile =
        index::profile_of({asked.array, asked.query.instant, ruler ? ruler->places : places}, stop);
    const std::vector<double> rows = index::rows_of(profile);
    Bytes bytes(rows.size() * sizeof(double));
    for (const double each : rows)
        bytes.put(each);
    Json line = answer_to(id, true);
    line["samples"] = profile.values.size();
    line["unit"] = asked.array->info().value_unit;
    line["length_unit"] = asked.array->info().length_unit;
    Json words = asked.words;
    words.erase("isovalue");
    return with_bytes(std::move(line), words, bytes.take());
}

} // namespace

ControlAnswer refused(const std::string& id, const std::string& why) {
    Json line = answer_to(id, false);
    line["error"] = why;
    return {text_of_line(line)};
}

ControlAnswer done(const std::string& id, std::uint64_t frame) {
    Json line = answer_to(id, true);
    if (frame > 0)
        line["frame"] = frame;
    return {text_of_line(line)};
}

ControlAnswer state_answer(const std::string& id, const ShownFrame& shown) {
    Json line = answer_to(id, true);
    line["frame"] = shown.number;
    line["state"] = state_of(shown);
    line["cells"] = cells_of(shown);
    line["statistics"] = statistics_of(shown);
    return {text_of_line(line)};
}

std::shared_ptr<const std::vector<std::byte>> picture_bytes(const ControlPicture& picture) {
    const render::Image& image = picture.image;
    const std::size_t pixels = image.rgba.size() / 4;
    Bytes bytes(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        std::array<std::uint8_t, 3> pixel{};
        std::copy_n(image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i), 3, pixel.begin());
        bytes.put(pixel);
    }
    return bytes.take();
}

ControlAnswer picture_answer(const std::string& id, const ControlPicture& picture,
                             std::shared_ptr<const std::vector<std::byte>> bytes) {
    Json line = answer_to(id, true);
    line["width"] = picture.image.width;
    line["height"] = picture.image.height;
    line["format"] = "rgb8";
    line["note"] = picture.note;
    ControlAnswer answer = with_bytes(std::move(line), Json::object(), std::move(bytes));
    answer.shared = true;
    return answer;
}

ControlAnswer searched_answer(const std::string& id, const ControlRequest& request,
                              const std::shared_ptr<const index::IndexFile>& file,
                              const ExplorerState& shown, const std::stop_token& stop) {
    const Searched asked = searched(request, file, shown);
    if (request.verb == ControlVerb::profile)
        return profile_answer(id, asked, request.places, shown.rulers, stop);
    return request.verb == ControlVerb::cells ? cells_answer(id, asked, stop)
                                              : mesh_answer(id, asked, stop);
}

std::string event_line(ControlTopic topic, const ShownFrame* before, const ShownFrame& now) {
    if (before && same(topic, *before, now))
        return {};
    const auto number = static_cast<std::size_t>(topic);
    Json line{{"event", kControlTopicNames[number]}, {"frame", now.number}};
    line[std::string(kControlTopicNames[number])] = told(topic, now);
    return text_of_line(line);
}

} // namespace isochron::app
