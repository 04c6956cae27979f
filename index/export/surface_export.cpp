// Makes the meshes of steps, colors their vertices, and hands them to the writer of a format: while a step
// is written, the next one is made.
#include "index/export/surface_export.h"

#include "index/error.h"
#include "index/search/first_crossing.h"
#include "index/search/surface_mesh.h"
#include "index/surface/cell_colors.h"
#include "index/surface/mesh_colors.h"
#include "index/volume/instant_text.h"

#include <fmt/format.h>

#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>

namespace isochron::index {
namespace {

/// A step with all that its surfaces refer to.
struct MadeStep {
    std::vector<ExportedMesh> meshes;
    std::vector<CellSet> cells; ///< where the format asks for them
    ExportedStep step;
};

class StepMaker {
  public:
    StepMaker(const std::shared_ptr<const IndexFile>& file, const SurfaceFormat& format,
              const std::filesystem::path& name, const ExportRequest& request)
        : file_(file), info_(file->info()), of_cells_(format.of_cells), name_(name),
          request_(request), meshes_(file) {
        wishes_.normals = request.plan.normals;
        if (request.values)
            wishes_.values = request.values->array;
        crossings_.resize(request.surfaces.size());
    }

    /// Adds what it makes to the count. @param look called now and then, by one thread at a time
    std::unique_ptr<MadeStep> make(std::uint32_t step, ExportCount& count,
                                   const std::function<void()>& look) {
        auto made = std::make_unique<MadeStep>();
        const std::size_t surfaces = request_.surfaces.size();
        made->meshes.reserve(surfaces); // surfaces point to them
        made->cells.resize(of_cells_ ? surfaces : 0);
        const Instant at(step, request_.plan.fraction);
        made->step = {
            .instant = at, .time = time_at(info_.times, at), .grid = &info_.grid, .surfaces = {}};
        std::uint64_t found = 0;
        for (std::size_t i = 0; i < surfaces; ++i)
            found += add_surface(*made, i, count, look);
        count.cells += found;
        if (found == 0)
            count.empty_steps.push_back(step);
        return made;
    }

  private:
    /// @return the number of its cells
    std::uint64_t add_surface(MadeStep& made, std::size_t number, ExportCount& count,
                              const std::function<void()>& look) {
        const SurfaceWish& wish = request_.surfaces[number];
        ExportedMesh& mesh = made.meshes.emplace_back(name_);
        CellSet* const cells = of_cells_ ? &made.cells[number] : nullptr;
        const Query query{made.step.instant, wish.isovalue};
        const bool by_crossing = request_.values && !request_.values->array;
        bool complete = false;
        if (cells) {
            complete = meshes_.find_cells(query, *cells, request_.stop);
        } else if (request_.reshape || by_crossing) {
            CellSet found;
            auto whole =
                meshes_.make_packed(query, wishes_, request_.stop, by_crossing ? &found : nullptr);
            complete = whole && (!by_crossing || add_first_crossings(number, found, *whole));
            if (complete) {
                if (request_.reshape)
                    request_.reshape(*whole, query, look);
                mesh.add(*std::move(whole));
            }
        } else {
            const auto take = [&](CellMesh piece) {
                look();
                mesh.add(std::move(piece));
            };
            complete = meshes_.make_pieces(query, wishes_, take, request_.stop);
        }
        if (!complete)
            throw Error("the export was canceled");
        ExportedSurface surface{.name = wish.name,
                                .color = wish.color,
                                .opacity = wish.opacity,
                                .mesh = &mesh,
                                .cells = cells,
                                .isovalue = wish.isovalue};
        if (request_.values && request_.values->color_of)
            surface.color_of = &request_.values->color_of;
        count.vertices += mesh.vertices();
        count.triangles += mesh.triangles();
        made.step.surfaces.push_back(std::move(surface));
        return cells ? cells->points.size() : mesh.cells();
    }

    /// Makes the times of the cells' first crossings the values of their vertices.
    /// @return false when stopped
    bool add_first_crossings(std::size_t number, const CellSet& cells, CellMesh& mesh) {
        FirstCrossingsPtr& known = crossings_[number];
        const double isovalue = cells.query.isovalue;
        if (!known)
            known = first_crossings(
                info_, search_in(file_, std::nullopt, Shading::none), isovalue, request_.stop,
                request_.values->blended ? crossings_between(file_, 0, isovalue, request_.stop)
                                         : nullptr);
        if (!known)
            return false;
        std::vector<std::uint16_t> coordinates(cells.ids.size());
        color_by_first_crossing(*known, info_.times, cells.query.instant, cells.ids, coordinates);
        color_by_cells(mesh, coordinates);
        for (const std::uint16_t color : std::exchange(mesh.colors, {}))
            mesh.values.push_back(
                color == kNoFineColor
                    ? std::numeric_limits<float>::quiet_NaN()
                    : static_cast<float>(std::lerp(info_.times.front(), info_.times.back(),
                                                   color / double{kFineColorSteps})));
        return true;
    }

    const std::shared_ptr<const IndexFile>& file_;
    const SeriesInfo& info_;
    bool of_cells_;
    const std::filesystem::path& name_;
    const ExportRequest& request_;
    MeshWishes wishes_;
    SurfaceMeshes meshes_;
    std::vector<FirstCrossingsPtr> crossings_; ///< by surface, once they are needed
};

std::uint64_t bytes_of(const MadeStep& made) {
    std::uint64_t bytes = 0;
    for (const ExportedMesh& mesh : made.meshes)
        bytes += mesh.held();
    for (const CellSet& cells : made.cells)
        bytes += cells.ids.size() * (sizeof(CellId) + sizeof(CellPoint));
    return bytes;
}

/// Writes steps on a thread of its own, in their order.
class StepsBehind {
  public:
    explicit StepsBehind(SurfaceWriter& writer)
        : writer_(writer), thread_([this](const std::stop_token& stop) { run(stop); }) {}

    /// Waits until there is room for the step: for one always, for more if they are small.
    /// @throws what writing an earlier step has thrown
    void add(std::unique_ptr<MadeStep> made) {
        const std::uint64_t bytes = bytes_of(*made);
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] {
            return failure_ || waiting_.empty() || waiting_bytes_ + bytes <= kMostWaiting;
        });
        if (failure_)
            std::rethrow_exception(failure_);
        waiting_bytes_ += bytes;
        waiting_.push_back(std::move(made));
        changed_.notify_all();
    }
    /// Returns when all are written. @throws as `add`
    void finish() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return failure_ || (waiting_.empty() && !writes_); });
        if (failure_)
            std::rethrow_exception(failure_);
    }

  private:
    static constexpr std::uint64_t kMostWaiting = std::uint64_t{16} << 20; ///< [byte]

    void run(const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        while (changed_.wait(lock, stop, [this] { return !waiting_.empty(); }) &&
               !stop.stop_requested()) {
            const std::unique_ptr<MadeStep> made = std::move(waiting_.front());
            waiting_.pop_front();
            waiting_bytes_ -= bytes_of(*made);
            writes_ = true;
            lock.unlock();
            changed_.notify_all();
            std::exception_ptr failure;
            try {
                writer_.add(made->step);
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            writes_ = false;
            failure_ = failure;
            changed_.notify_all();
            if (failure)
                return;
        }
    }

    SurfaceWriter& writer_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::deque<std::unique_ptr<MadeStep>> waiting_;
    std::uint64_t waiting_bytes_ = 0;
    bool writes_ = false;
    std::exception_ptr failure_;
    std::jthread thread_; ///< last: begins when all else is there; its end leaves what waits
};

} // namespace

ExportCount export_surfaces(const std::shared_ptr<const IndexFile>& file,
                            const SurfaceFormat& format, const std::filesystem::path& name,
                            const ExportRequest& request, const Progress& progress) {
    StepMaker maker(file, format, name, request);
    const auto writer = format.make(request.plan, name);
    ExportCount count;
    std::size_t done = 0;
    StepsBehind written(*writer);
    const auto look = [&] {
        if (progress)
            progress("exporting",
                     static_cast<double>(done) / static_cast<double>(request.plan.steps.size()));
    };
    for (const std::uint32_t step : request.plan.steps) {
        look();
        written.add(maker.make(step, count, look));
        ++done;
    }
    written.finish();
    writer->finish();
    if (progress)
        progress("exporting", 1);
    return count;
}

} // namespace isochron::index
