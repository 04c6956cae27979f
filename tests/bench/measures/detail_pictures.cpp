// Draws sets of levels of detail beside all cells.
#include "tests/bench/measures/detail_pictures.h"

#include "app/quality/detail_choice.h"
#include "index/extraction/extraction.h"
#include "render/cells/cell_buffers.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/driver.h"
#include "render/gl/render_target.h"
#include "tests/bench/measures/render_camera.h"
#include "tests/bench/measures/timing.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <vector>

namespace isochron::bench {
namespace {

constexpr int kDraws = 9, kEyes = 2, kOff = 8;
constexpr double kShare = 0.75; ///< of the budget, as app/quality/frame_quality.cpp has it
constexpr std::uint64_t kAll = 100'000'000;

template <class Work>
double ms_of(Work&& work) {
    const auto started = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started)
        .count();
}

/// One place to look from.
class DetailView {
  public:
    DetailView(const render::Gl& gl, const std::shared_ptr<const index::IndexFile>& file,
               const DetailOptions& options)
        : gl_(gl), grid_(file->info().grid), pass_(gl), query_{options.step, {options.isovalue}},
          camera_(bench_camera(file->info(), options.picture, kEyes)),
          target_(gl, {kEyes * options.picture, options.picture}),
          extract_(index::extract_from(file, std::nullopt, index::Shading::cells)) {
        look_.linear_light = !render::draws_in_software(gl); // as in a session
    }

    index::ExtractionPtr cells(const index::DetailQuery& detail) {
        index::SurfacesQuery query = query_;
        query.detail = detail;
        return extract_(query, {});
    }
    render::Image picture(const index::ExtractionPtr& set, double* draw_ms = nullptr) {
        render::CellBuffers buffers(gl_, grid_);
        while (!buffers.upload(set, std::numeric_limits<std::size_t>::max(),
                               render::SendVolume::never))
            if (buffers.refused())
                throw render::Error(buffers.refusal());
        std::vector<double> times;
        for (int i = 0; i < (draw_ms ? kDraws : 1); ++i) {
            target_.bind();
            target_.clear({0, 0, 0, 0});
            gl_.Finish();
            times.push_back(ms_of([&] {
                pass_.draw(swaying_.next(), camera_.placement, buffers, render::Footprint::quad,
                           look_);
                gl_.Finish();
            }));
        }
        if (draw_ms)
            *draw_ms = median(times);
        return target_.read();
    }
    const BenchCamera& camera() const { return camera_; }
    const index::Grid& grid() const { return grid_; }

  private:
    const render::Gl& gl_;
    index::Grid grid_;
    render::CellPass pass_;
    render::CellAppearance look_;
    index::SurfacesQuery query_;
    BenchCamera camera_;
    SwayingViews swaying_{camera_.views};
    render::RenderTarget target_;
    index::Extract extract_;
};

/// Times as many pixels along each side has the picture of all cells whose area is compared: cells
/// below a pixel are drawn as large as one, which makes thin and small things larger.
constexpr int kFiner = 3;

bool has_light(const render::Image& image, int x, int y) {
    return image.at(x, y)[3] >= 128;
}

} // namespace

MovingDetail measure_moving_detail(const render::Gl& gl,
                                   const std::shared_ptr<const index::IndexFile>& file,
                                   const DetailOptions& options) {
    DetailView view(gl, file, options);
    app::DetailChoice choice(view.grid(), kAll);
    choice.look(view.camera().views, view.camera().placement);
    MovingDetail moving;
    index::ExtractionPtr set;
    render::Image image;
    std::optional<double> fit;
    std::uint64_t drawn = 0;
    for (int round = 0; round < 20; ++round) { // until the number of cells stays
        const index::DetailQuery detail = choice.for_motion(fit, drawn);
        if (set && detail.most_cells == drawn)
            break;
        moving.extract_ms = ms_of([&] { set = view.cells(detail); });
        image = view.picture(set, &moving.draw_ms);
        drawn = detail.most_cells;
        fit = kShare * options.budget_ms / moving.draw_ms * static_cast<double>(set->cells());
    }
    moving.cells = set->cells();
    if (set->coarse()) {
        moving.finest = std::ranges::min(set->detail);
        moving.coarsest = std::ranges::max(set->detail);
    }
    DetailOptions finer = options;
    finer.picture *= kFiner;
    DetailView fine(gl, file, finer);
    const index::ExtractionPtr all = fine.cells({});
    moving.all_cells = all->cells();
    const render::Image exact = fine.picture(all);
    double lit = 0, extra = 0, missed = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            int inside = 0;
            for (int i = 0; i < kFiner * kFiner; ++i)
                inside += has_light(exact, kFiner * x + i % kFiner, kFiner * y + i / kFiner);
            const bool a = 2 * inside > kFiner * kFiner, b = has_light(image, x, y);
            lit += a;
            extra += b && !a;
            missed += a && !b;
        }
    moving.extra_percent = 100 * extra / std::max(lit, 1.0);
    moving.missed_percent = 100 * missed / std::max(lit, 1.0);
    return moving;
}

double measure_settled_detail(const render::Gl& gl,
                              const std::shared_ptr<const index::IndexFile>& file,
                              const DetailOptions& options) {
    DetailView view(gl, file, options);
    app::DetailChoice choice(view.grid(), kAll);
    choice.look(view.camera().views, view.camera().placement);
    const render::Image all = view.picture(view.cells({}));
    const render::Image rest = view.picture(view.cells(choice.at_rest()));
    std::size_t off = 0;
    const std::size_t pixels = all.rgba.size() / 4;
    for (std::size_t i = 0; i < pixels; ++i) {
        int most = 0;
        for (std::size_t c = 0; c < 3; ++c)
            most = std::max(most, std::abs(int{all.rgba[4 * i + c]} - int{rest.rgba[4 * i + c]}));
        off += most > kOff;
    }
    return 100.0 * static_cast<double>(off) / static_cast<double>(pixels);
}

} // namespace isochron::bench
