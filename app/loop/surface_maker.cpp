// Surfaces that a session exports as files.
#include "app/loop/surface_maker.h"

#include "app/end_in_time.h"
#include "app/output/export_request.h"
#include "app/text.h"
#include "index/error.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace isochron::app {

/// What an export does, and where.
struct ExportTask {
    std::shared_ptr<const index::IndexFile> array; ///< array of the surfaces
    index::ExportRequest request;
    const index::SurfaceFormat* format;
    std::filesystem::path folder;
};

namespace {

namespace fs = std::filesystem;
using interaction::ExportWork;

bool exists_any(const std::vector<fs::path>& files) {
    return std::ranges::any_of(files, [](const fs::path& file) {
        std::error_code ignored;
        return fs::exists(fs::symlink_status(file, ignored));
    });
}

/// The files of the export under the first name that none of them has yet.
std::vector<fs::path> free_names(const ExportTask& task, fs::path& name) {
    for (int number = 1;; ++number) {
        name =
            task.folder / fmt::format("isochron_surface_{:04}{}", number, task.format->extension);
        std::vector<fs::path> files = index::files_of_export(*task.format, name, task.request.plan,
                                                             task.request.surfaces.size());
        if (!exists_any(files))
            return files;
    }
}

/// @return what the user is told
std::string write_surfaces(const ExportTask& task, const Asking& asking) {
    index::make_folder(task.folder);
    fs::path name;
    const std::vector<fs::path> files = free_names(task, name);
    index::ExportRequest request = task.request;
    request.stop = asking.stop;
    const auto progress = [&](std::string_view, double fraction) {
        if (asking.stop.stop_requested())
            throw index::Error("the export was canceled");
        asking.progress(static_cast<std::uint32_t>(100 * fraction));
    };
    const index::ExportCount count =
        index::export_surfaces(task.array, *task.format, name, request, progress);
    const std::string all =
        files.size() == 1
            ? whole_path(files.front())
            : fmt::format("{} and {} more", whole_path(files.front()), files.size() - 1);
    if (count.cells == 0)
        return fmt::format("exported {}: there is no surface at this isovalue", all);
    return fmt::format("exported {}: {} {}", all,
                       grouped(task.format->of_cells ? count.cells : count.triangles),
                       task.format->of_cells ? "cells" : "triangles") +
           (request.values && !task.format->with_colors ? ", without the colors of an array" : "");
}

std::string not_written(const ExportTask&, const std::string& why, bool canceled) {
    return canceled ? "canceled: the export; steps that were written stay" : why;
}

} // namespace

SurfaceMaker::SurfaceMaker(std::shared_ptr<const index::IndexFile> file, fs::path folder)
    : file_(std::move(file)), folder_(std::move(folder)), exports_(write_surfaces, not_written) {}

void SurfaceMaker::before_frame(Session& session, const interaction::Commands& by_user,
                                interaction::Commands& asked) {
    file_ = session.file(); // it may have more steps
    const auto exported = update(session.state(), [&] { return session.scale(); });
    if (!by_user.exporting && !asked.exporting) // what somebody asks for counts
        asked.exporting = exported;
}

std::vector<std::string> SurfaceMaker::finish() {
    exports_.cancel();
    {
        const DrawsOnly waits; // maybe for a disk
        exports_.finish();
    }
    take_ended();
    return messages();
}

void SurfaceMaker::begin(const ExplorerState& state, std::optional<ColorScale> scale) {
    goes_on_ = true;
    told_ = 0;
    const std::string& chosen = state.pictures.folder;
    exports_.ask({.array = array_of(file_, array_of_surface(state, state.picked, *file_)),
                  .request = shown_request(state, file_, std::move(scale)),
                  .format = index::surface_format(state.pictures.surfaces.format),
                  .folder = chosen.empty() ? folder_ : fs::path(chosen)});
}

void SurfaceMaker::take_ended() {
    for (std::string& said : exports_.take()) {
        messages_.push_back(std::move(said));
        goes_on_ = false;
    }
}

std::optional<ExportWork>
SurfaceMaker::update(const ExplorerState& state,
                     const std::function<std::optional<ColorScale>()>& scale) {
    const bool wanted = state.exporting.goes_on;
    if (!goes_on_) {
        if (wanted)
            begin(state, scale ? scale() : std::nullopt);
        return std::nullopt;
    }
    if (!wanted)
        exports_.cancel();
    const std::uint32_t percent = exports_.percent();
    take_ended();
    if (!goes_on_)
        return wanted ? std::optional(ExportWork{}) : std::nullopt;
    if (!wanted || std::exchange(told_, percent) == percent)
        return std::nullopt;
    return ExportWork{true, percent};
}

} // namespace isochron::app
