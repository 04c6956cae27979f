// Surfaces that a session exports as files.
#include "app/output/surface_maker.h"

#include "app/output/export_request.h"
#include "app/text.h"
#include "index/error.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <stop_token>
#include <system_error>
#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using interaction::ExportWork;

/// What an export does, and where.
struct ExportTask {
    std::shared_ptr<const index::IndexFile> array; ///< array of the surfaces
    index::ExportRequest request;
    const index::SurfaceFormat* format;
    fs::path folder;
};

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
std::string write_surfaces(const ExportTask& task, const index::Progress& progress) {
    index::make_folder(task.folder);
    fs::path name;
    const std::vector<fs::path> files = free_names(task, name);
    const index::ExportCount count =
        index::export_surfaces(task.array, *task.format, name, task.request, progress);
    const std::string all =
        files.size() == 1 ? files.front().string()
                          : fmt::format("{} and {} more", files.front().string(), files.size() - 1);
    if (count.cells == 0)
        return fmt::format("exported {}: there is no surface at this isovalue", all);
    return fmt::format("exported {}: {} {}", all,
                       grouped(task.format->of_cells ? count.cells : count.triangles),
                       task.format->of_cells ? "cells" : "triangles");
}

} // namespace

/// Shared with the thread that writes.
struct SurfaceMaker::Export {
    std::stop_source stop;
    std::atomic<std::uint32_t> percent = 0;
    std::atomic<bool> done = false;
    std::uint32_t told = 0; ///< percent that the asking thread has told
};

SurfaceMaker::SurfaceMaker(std::shared_ptr<const index::IndexFile> file, fs::path folder,
                           std::function<void()> wake)
    : file_(std::move(file)), folder_(std::move(folder)), wake_(std::move(wake)) {
    work_.set_wake(wake_);
}

SurfaceMaker::~SurfaceMaker() {
    if (now_)
        now_->stop.request_stop();
}

std::vector<std::string> SurfaceMaker::finish() {
    if (now_)
        now_->stop.request_stop();
    try {
        work_.finish();
    } catch (const index::Error&) { // it is among the messages
    }
    return messages();
}

void SurfaceMaker::begin(const ExplorerState& state, std::optional<ColorScale> scale) {
    ExportTask task{.array = array_of(file_, file_->array_called(state.array).value_or(0)),
                    .request = shown_request(state, file_, std::move(scale)),
                    .format = index::surface_format(state.pictures.surfaces.format),
                    .folder =
                        state.pictures.folder.empty() ? folder_ : fs::path(state.pictures.folder)};
    now_ = std::make_shared<Export>();
    task.request.stop = now_->stop.get_token();
    work_.post([task = std::move(task), now = now_, wake = wake_] {
        const auto progress = [&](std::string_view, double fraction) {
            if (now->stop.stop_requested())
                throw index::Error("the export was canceled");
            const auto percent = static_cast<std::uint32_t>(100 * fraction);
            if (now->percent.exchange(percent) != percent && wake)
                wake();
        };
        std::string said;
        try {
            said = write_surfaces(task, progress);
        } catch (const std::exception& error) {
            said = now->stop.stop_requested() ? "canceled: the export; steps that were written stay"
                                              : error.what();
        }
        now->done = true;
        return said;
    });
}

std::optional<ExportWork>
SurfaceMaker::update(const ExplorerState& state,
                     const std::function<std::optional<ColorScale>()>& scale) {
    const bool wanted = state.exporting.goes_on;
    if (!now_) {
        if (wanted)
            begin(state, scale ? scale() : std::nullopt);
        return std::nullopt;
    }
    if (!wanted)
        now_->stop.request_stop();
    if (now_->done) {
        now_.reset();
        return wanted ? std::optional(ExportWork{}) : std::nullopt;
    }
    const std::uint32_t percent = now_->percent;
    if (!wanted || std::exchange(now_->told, percent) == percent)
        return std::nullopt;
    return ExportWork{true, percent};
}

} // namespace isochron::app
