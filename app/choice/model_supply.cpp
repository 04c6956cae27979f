// Reads models beside the frames.
#include "app/choice/model_supply.h"

#include "app/text.h"
#include "index/readers/formats/model_file.h"
#include "index/system/links/link.h"
#include "index/system/whole_path.h"
#include "index/volume/grid_corners.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cctype>
#include <memory>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using Box = std::array<glm::dvec3, 2>;

Box box_of(const index::Grid& grid) {
    const auto corners = index::corners_of(grid);
    Box box{corners[0], corners[0]};
    for (const glm::dvec3& at : corners)
        box = {glm::min(box[0], at), glm::max(box[1], at)};
    return box;
}

Box with(const Box& a, const Box& b) {
    return {glm::min(a[0], b[0]), glm::max(a[1], b[1])};
}

double span(const Box& box) {
    return glm::distance(box[0], box[1]);
}

} // namespace

ModelSupply::ModelSupply(const fs::path& data)
    : reading_(read, [](const Wanted& wanted, const std::string& why, bool) {
          const bool named = why.find(wanted.file.filename().string()) != std::string::npos;
          return Read{wanted.path, nullptr,
                      named ? why : fmt::format("{}: {}", wanted.file.string(), why)};
      }) {
    if (!index::is_link(data.string()))
        add_folder(data.parent_path());
}

void ModelSupply::add_folder(const fs::path& folder) {
    const fs::path real = index::whole_path(folder.empty() ? fs::path(".") : folder);
    if (std::ranges::find(folders_, real) == folders_.end())
        folders_.push_back(real);
}

std::string ModelSupply::allow(const fs::path& file) {
    const fs::path real = index::whole_path(file.is_absolute() ? file : place_of(file.string()));
    allowed_.insert(real);
    for (auto& [path, known] : known_)
        if (!known.fault.empty() && index::whole_path(place_of(path)) == real)
            known = {};
    for (const fs::path& folder : folders_)
        if (index::lies_within(real, folder))
            return real.lexically_relative(folder).string();
    return real.string();
}

void ModelSupply::allow_those_of(const interaction::Commands& commands) {
    const auto allow_each = [this](const std::optional<std::vector<interaction::Model>>& models) {
        for (std::size_t i = 0; models && i < models->size(); ++i)
            allow((*models)[i].path);
    };
    allow_each(commands.models);
    for (std::size_t i = 0; commands.keys && i < commands.keys->size(); ++i)
        allow_each((*commands.keys)[i].models);
}

std::vector<std::string> ModelSupply::allowed(const ExplorerState& state) const {
    std::vector<std::string> files;
    for (const interaction::Model& model : state.models)
        if (const fs::path real = index::whole_path(place_of(model.path)); allowed_.contains(real))
            files.push_back(real.string());
    return files;
}

/// Where a model lies: a relative path in the first folder that has such a file.
fs::path ModelSupply::place_of(const std::string& path) const {
    if (fs::path(path).is_absolute() || folders_.empty())
        return path;
    std::error_code error;
    for (const fs::path& folder : folders_)
        if (fs::exists(folder / path, error) ||
            (index::is_model_series(path) && fs::exists((folder / path).parent_path(), error)))
            return folder / path;
    return folders_.front() / path;
}

bool ModelSupply::may_open(const fs::path& file) const {
    const fs::path real = index::whole_path(file);
    return all_ || allowed_.contains(real) ||
           std::ranges::any_of(
               folders_, [&](const fs::path& folder) { return index::lies_within(real, folder); });
}

ModelSupply::Read ModelSupply::read(const Wanted& wanted, const Asking& asking) {
    const fs::path file = wanted.step
                              ? index::file_of_model_series(wanted.file, *wanted.step, wanted.steps)
                              : wanted.file;
    return {wanted.path,
            std::make_shared<const index::TriangleMesh>(
                index::read_model(file, wanted.unit, asking.stop)),
            {}};
}

void ModelSupply::complain(Known& known, const std::string& fault) {
    known.fault = fault;
    std::ranges::replace_if(known.fault, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    messages_.push_back(known.fault);
    faults_.push_back(known.fault);
}

/// Whether it is still to be asked for, or for another step. Remembers for which.
bool ModelSupply::wants_file(Known& known, const std::string& path, std::uint32_t step) {
    if (known.reading)
        return false;
    const bool first = !std::exchange(known.asked, true);
    if (!index::is_model_series(path) || !known.fault.empty())
        return first;
    return std::exchange(known.step, step) != step;
}

void ModelSupply::ask(const std::string& path, Known& known, const Frame& frame) {
    const fs::path file = place_of(path);
    if (index::is_link(path))
        return complain(known, fmt::format("{}: is an address, expected a file", path));
    if (!may_open(file)) {
        known.refused = true;
        return complain(known, fmt::format("{}: not opened: it lies outside of the folder of the "
                                           "data; its eye in the list of models, or --model, opens "
                                           "it",
                                           file.string()));
    }
    ++reads_;
    known.reading = true;
    reading_.ask({path, file, frame.file.info().length_unit, known.step, frame.steps});
}

void ModelSupply::take(const index::SeriesInfo& info) {
    for (Read& read : reading_.take()) {
        --reads_;
        const auto found = known_.find(read.path);
        if (found == known_.end())
            continue;
        Known& known = found->second;
        known.reading = false;
        if (!read.failure.empty()) {
            complain(known, read.failure);
            continue;
        }
        const bool is_first = !std::exchange(known.mesh, std::move(read.mesh));
        known.box = bounds(*known.mesh);
        const Box data = box_of(info.grid);
        if (const double times = span(with(data, known.box)) / span(data);
            is_first && !(times <= kMostSpan))
            messages_.push_back(fmt::format(
                "{}: lies far from the data, or is large: both together are {:.3g} times as wide "
                "as "
                "the data. The first view leaves it out; are its coordinates in the unit of the "
                "data{}?",
                read.path, times, info.length_unit.empty() ? "" : ", " + info.length_unit));
    }
}

void ModelSupply::update(const Frame& frame) {
    std::erase_if(known_, [&](const auto& known) {
        return std::ranges::find(frame.state.models, known.first, &interaction::Model::path) ==
               frame.state.models.end();
    });
    take(frame.file.info());
    const std::uint32_t step = frame.state.shown_instant().step;
    for (const interaction::Model& model : frame.state.models)
        if (Known& known = known_[model.path]; model.shown && wants_file(known, model.path, step))
            ask(model.path, known, frame);
    if (!frame.is_live() && reads_ > 0) {
        reading_.finish();
        take(frame.file.info());
    }
}

std::vector<ShownTriangles> ModelSupply::shown(const ExplorerState& state) const {
    std::vector<ShownTriangles> shown;
    for (const interaction::Model& model : state.models)
        if (const auto known = known_.find(model.path);
            model.shown && known != known_.end() && known->second.mesh)
            shown.push_back(
                {known->second.mesh,
                 {.color = model.color, .opacity = model.opacity, .lines = model.lines}});
    return shown;
}

std::vector<ListedModel> ModelSupply::listed(const ExplorerState& state) const {
    std::vector<ListedModel> lines;
    for (const interaction::Model& model : state.models) {
        ListedModel line;
        if (const auto known = known_.find(model.path); known != known_.end()) {
            line.fault = known->second.fault;
            line.refused = known->second.refused;
            if (known->second.mesh) {
                line.words = fmt::format("{} triangles", grouped(known->second.mesh->triangles()));
                line.box = known->second.box;
            }
        }
        if (line.words.empty() && line.fault.empty())
            line.words = model.shown ? "it is being read" : "hidden";
        lines.push_back(std::move(line));
    }
    return lines;
}

std::array<glm::dvec3, 2> ModelSupply::box(const ExplorerState& state,
                                           const index::Grid& grid) const {
    const Box data = box_of(grid);
    Box all = data;
    for (const interaction::Model& model : state.models)
        if (const auto known = known_.find(model.path);
            model.shown && known != known_.end() && known->second.mesh)
            if (const Box wider = with(all, known->second.box);
                span(wider) <= kMostSpan * span(data))
                all = wider;
    return all;
}

} // namespace isochron::app
