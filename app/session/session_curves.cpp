// The curves of a session.
#include "app/session/session_curves.h"

#include "app/end_in_time.h"
#include "app/text.h"
#include "index/file/color_source.h"
#include "index/measure/kept_pieces.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <system_error>
#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// The number of a subject in the list, which gets it unless it has it.
std::size_t number_of(const CurveSubject& subject, std::vector<CurveSubject>& subjects) {
    const auto there = std::ranges::find(subjects, subject);
    if (there != subjects.end())
        return static_cast<std::size_t>(there - subjects.begin());
    subjects.push_back(subject);
    return subjects.size() - 1;
}

/// The whole cells in a box, between vertices of the grid; nothing if it has none.
std::optional<index::VertexBox> cells_in(const interaction::ClipBox& box, const index::Grid& grid) {
    index::VertexBox cells;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<glm::length_t>(axis);
        const double first = std::max(std::ceil(box.low[at]), 0.0);
        const double last = std::min(std::floor(box.high[at]), grid.vertices[axis] - 1.0);
        if (!(first < last))
            return std::nullopt;
        cells.first[axis] = static_cast<std::uint32_t>(first);
        cells.last[axis] = static_cast<std::uint32_t>(last);
    }
    return cells;
}

/// Writes a table under a name that no file has. @return its path
fs::path write_table(const fs::path& folder, const char* name, const std::string& text) {
    index::make_folder(folder);
    fs::path path;
    std::error_code ignored;
    for (int number = 1; number == 1 || fs::exists(fs::symlink_status(path, ignored)); ++number)
        path = folder / fmt::format("isochron_{}_{:04}.csv", name, number);
    index::write_file(path, text);
    return path;
}

} // namespace

SessionCurves::SessionCurves(CurveMaker::Measure measure)
    : maker_(std::move(measure)),
      profiling_(
          [](const index::ProfileQuery& query, const Asking& asking) {
              return Profiled{
                  query,
                  std::make_shared<index::Profile>(index::profile_of(query, asking.stop)),
                  {}};
          },
          [](const index::ProfileQuery& query, const std::string& why, bool) {
              return Profiled{query, nullptr, why};
          }) {}

std::optional<glm::dvec3> marked_place(const interaction::Settings& settings) {
    return settings.mark.point ? std::optional(settings.mark.point->position) : std::nullopt;
}

void SessionCurves::set_wake(const std::function<void()>& wake) {
    maker_.set_wake(wake);
    writing_.set_wake(wake);
    profiling_.set_wake(wake);
}

void SessionCurves::write_to(CurveFolders folders) {
    if (folders.kept)
        maker_.keep_in(KeptCurves(*folders.kept));
    folders_ = std::move(folders);
}

/// One profile is made at a time; the newest wish follows it.
void SessionCurves::update_profile(const Frame& frame, const ShownArrays& arrays, bool seen) {
    const auto take = [&] {
        for (Profiled& each : profiling_.take()) {
            profile_comes_ = false;
            profiled_ = std::move(each);
        }
    };
    take();
    const interaction::Ruler* const ruler = frame.state.rulers.chosen();
    profile_wanted_ = seen && ruler && ruler->complete();
    if (!profile_wanted_)
        return;
    const index::ProfileQuery query{arrays.held(frame.state), frame.state.shown_instant(),
                                    ruler->places};
    if (profiled_.query == query || profile_comes_)
        return;
    profile_comes_ = profiling_.ask(query);
    if (frame.is_live() && frame.sharing.alone())
        return;
    const DrawsOnly waits; // replays, and all walls, show the same
    profiling_.finish();
    take();
}

void SessionCurves::update(const Frame& frame, const ShownArrays& arrays,
                           const index::Extractor& extractor) {
    const ExplorerState& state = frame.state;
    // The panel over a picture is not laid out in a replay.
    const bool seen = state.room_panel.shown || (state.panel && frame.is_live());
    WantedCurves wanted;
    wanted.now = state.shown_instant().step;
    wanted.paused = frame.is_live() && extractor.busy();
    of_surface_.assign(state.isosurfaces.size(), std::nullopt);
    of_mark_.reset();
    only_whole_ = state.room_panel.shown && !frame.sharing.alone();
    if (state.curves.shown && seen) {
        const index::SeriesInfo& info = arrays.file()->info();
        CurveSubject subject{.array = nullptr};
        if (state.clip.shown)
            subject.clip = state.clip;
        if (state.clip_box.shown)
            subject.box = cells_in(state.clip_box, info.grid);
        if (state.coloring.by == interaction::ColorBy::value &&
            index::ColorSource::count(*arrays.file()) > 0)
            subject.on_surface = color_array(state, *arrays.file());
        if (state.curves.measure == kDistanceCurve) // else a new mark would make all curves anew
            subject.from = marked_place(state);
        for (std::size_t i = 0; i < state.isosurfaces.size(); ++i) {
            subject.array = arrays.held(state, i);
            subject.isovalue = state.isosurfaces[i].isovalue;
            subject.kept =
                index::of_surface(filter_of(state.pieces), static_cast<std::uint32_t>(i));
            if (state.isosurfaces[i].opacity > 0 && (subject.box || !state.clip_box.shown))
                of_surface_[i] = number_of(subject, wanted.subjects);
        }
        if (const auto place = marked_place(state))
            of_mark_ =
                number_of({.array = arrays.called(state.mark.point->array, state), .place = place},
                          wanted.subjects);
        wanted.at_hand = extractor.at_hand();
    }
    update_profile(frame, arrays,
                   state.curves.shown && state.curves.measure == kProfileCurve && seen);
    maker_.update(wanted);
    if (!frame.is_live() && !wanted.subjects.empty()) { // replays are the same each time
        const DrawsOnly waits;
        maker_.finish();
    }
}

std::vector<StepCurvePtr> SessionCurves::shown(bool of_mark) {
    std::vector<StepCurvePtr> curves = maker_.curves();
    std::erase_if(curves, [&](const StepCurvePtr& each) {
        return each->subject.place.has_value() != of_mark;
    });
    return curves;
}

void SessionCurves::save(const ExplorerState& state) {
    const std::string& chosen = state.pictures.folder;
    const fs::path folder = chosen.empty() ? folders_->tables : fs::path(chosen);
    if (state.curves.measure == kProfileCurve) {
        if (const index::ProfilePtr profile = profile_wanted_ ? profiled_.profile : nullptr)
            writing_.post([folder, profile] {
                return "saved " +
                       whole_path(write_table(folder, "profile", index::csv_of(*profile)));
            });
        return;
    }
    const std::vector<StepCurvePtr> curves = shown(state.curves.measure == kMarkCurve);
    if (curves.empty())
        return;
    writing_.post([folder, curves] {
        return fmt::format(
            "saved {}: {} of {} steps", whole_path(write_table(folder, "curves", csv_of(curves))),
            std::ranges::count(curves.front()->known, std::uint8_t{1}), curves.front()->steps());
    });
}

PanelCurves SessionCurves::in_panel(const ExplorerState& state) {
    const std::vector<StepCurvePtr> curves = maker_.curves();
    const auto curve = [&](const std::optional<std::size_t>& number) {
        const bool there =
            number && *number < curves.size() && (!only_whole_ || curves[*number]->left == 0);
        return there ? curves[*number] : nullptr;
    };
    PanelCurves all;
    for (const auto& number : of_surface_)
        all.surfaces.push_back(curve(number));
    all.mark = curve(of_mark_);
    if (profile_wanted_)
        all.profile = profiled_.profile;
    all.failure = profile_wanted_ ? profiled_.failure : maker_.failure();
    if (folders_)
        all.save = [this, &state] { save(state); };
    return all;
}

} // namespace isochron::app
