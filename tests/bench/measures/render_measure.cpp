// Measures frames, their stages and their rivals, in turn.
#include "tests/bench/measures/render_measure.h"

#include "index/extraction/extractor.h"
#include "render/gl/driver.h"
#include "render/gl/render_target.h"
#include "tests/bench/measures/render_camera.h"
#include "tests/bench/measures/sent_ids.h"
#include "tests/bench/measures/stopwatch.h"
#include "tests/bench/measures/timing.h"
#include "tests/bench/rivals/bare_quads.h"
#include "tests/bench/rivals/vtk_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace isochron::bench {

namespace {

using render::Footprint;

constexpr std::size_t kUploadBytes = 4 << 20;                   ///< per frame, while time plays
constexpr std::uint64_t kPlentyOfRoom = std::uint64_t{1} << 40; ///< [byte]
constexpr glm::vec4 kBackground(0.02f, 0.02f, 0.03f, 1.0f);

double wall_ms() {
    using Milliseconds = std::chrono::duration<double, std::milli>;
    return Milliseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Times of frames of one kind: wall-clock time, and processor time of all threads, which depends
/// less on other work on the machine.
class Frames {
  public:
    template <class Frame>
    void time(Frame&& frame) {
        const Stopwatch processors(Stopwatch::Of::all_threads);
        const double start = wall_ms();
        frame();
        wall_.push_back(wall_ms() - start);
        processor_.push_back(1e3 * processors.seconds());
    }
    double ms() const { return wall_.empty() ? 0.0 : median(wall_); }
    double processor_ms() const { return wall_.empty() ? 0.0 : median(processor_); }
    bool empty() const { return wall_.empty(); }
    const std::vector<double>& all_ms() const { return wall_; }

  private:
    std::vector<double> wall_, processor_;
};

/// Whether cells of this footprint are drawn back to front, as blended rectangles.
bool is_blended(Footprint footprint) {
    return footprint == Footprint::gaussian;
}

/// As in a session in motion, where quads and meshes need no volume.
render::SendVolume volume_for(Footprint footprint) {
    return footprint == Footprint::quad || footprint == Footprint::mesh
               ? render::SendVolume::never
               : render::SendVolume::with_cells;
}

/// Radius in voxels of the largest cells, if the footprint is an ellipse or a rectangle; else
/// empty.
std::optional<float> radius_of(Footprint footprint, const render::FootprintShapes& shapes) {
    if (render::has_layers(footprint))
        return std::nullopt;
    return shapes.radius_of(footprint);
}

/// Times of all frames of one row, and of the stages of whole frames.
struct Times {
    Frames whole, vtk, bare, quads, extract, order, upload, draw;
    std::vector<double> cells;
};

std::optional<double> rate(const Frames& frames) {
    return frames.empty() ? std::nullopt : std::optional(1e3 / frames.ms());
}

std::optional<double> processor_ms(const Frames& frames) {
    return frames.empty() ? std::nullopt : std::optional(frames.processor_ms());
}

/// One picture of one series: the program's frame, and the frames of its rivals.
class Bench {
  public:
    Bench(const render::Gl& gl, std::shared_ptr<const index::IndexFile> file,
          const RenderOptions& options, const Picture& picture)
        : gl_(gl), file_(std::move(file)), options_(options), picture_(picture),
          camera_(bench_camera(file_->info(), picture.size, picture.eyes)),
          target_(gl, {picture.size * picture.eyes, picture.size}), pass_(gl), as_quads_(gl),
          cells_(gl, file_->info().grid), orders_(gl), bare_(gl) {
        look_.linear_light = !render::draws_in_software(gl); // as in a session
        as_quads_.draw_without_points();
        as_quads_.draw_hidden_cells();
        if (options.vtk && options.context != stereo::ContextKind::osmesa)
            vtk_ = vtk_scene(file_->values(), camera_.poses, picture.size, options.threads);
    }

    RenderRow measure(const NamedFootprint& footprint,
                      const std::function<void(double)>& progress) {
        const auto steps = static_cast<std::uint32_t>(file_->info().steps());
        const unsigned rounds = std::max(options_.rounds, 1u);
        Times times;
        mesh_room_ = footprint.footprint == Footprint::mesh ? kPlentyOfRoom : 0;
        const std::size_t frames = std::size_t{steps} * rounds;
        measure_step(footprint.footprint, 0, times); // warms everything up
        times = {};
        for (std::size_t i = 0; i < frames; ++i) {
            progress(0.6 * static_cast<double>(i) / static_cast<double>(frames));
            measure_step(footprint.footprint, static_cast<std::uint32_t>(i % steps), times);
        }
        RenderRow row = row_of(footprint, times);
        play(footprint.footprint, frames, row,
             [&](double fraction) { progress(0.6 + 0.4 * fraction); });
        return row;
    }

  private:
    RenderRow row_of(const NamedFootprint& footprint, const Times& times) const {
        RenderRow row;
        row.data = options_.data;
        row.footprint = footprint.name;
        row.size = picture_.size;
        row.eyes = picture_.eyes;
        row.threads = options_.threads;
        row.context = stereo::name_of(options_.context);
        for (const double cells : times.cells)
            row.cells += cells / static_cast<double>(times.cells.size());
        row.fps = *rate(times.whole);
        row.vtk_fps = rate(times.vtk);
        row.bare_fps = rate(times.bare);
        row.extract_ms = times.extract.ms();
        row.order_ms = times.order.ms();
        row.upload_ms = times.upload.ms();
        row.draw_ms = times.draw.ms();
        if (!times.quads.empty())
            row.quads_ms = times.quads.ms();
        row.frame_cpu_ms = times.whole.processor_ms();
        row.draw_cpu_ms = times.draw.processor_ms();
        row.quads_cpu_ms = processor_ms(times.quads);
        row.bare_cpu_ms = processor_ms(times.bare);
        row.vtk_cpu_ms = processor_ms(times.vtk);
        return row;
    }

    void draw(render::CellPass& pass, Footprint footprint) {
        target_.bind();
        target_.clear(kBackground);
        pass.draw(swaying_.next(), camera_.placement, cells_, footprint, look_);
        gl_.Finish();
    }

    void measure_step(Footprint footprint, std::uint32_t step, Times& times) {
        const index::Query query{index::Instant(step), options_.isovalue};
        const render::SendVolume volume = volume_for(footprint);
        gl_.Finish();
        index::ExtractionPtr set;
        times.whole.time([&] {
            times.extract.time([&] {
                set = extract_({.instant = index::Instant(step),
                                .isovalues = {options_.isovalue},
                                .mesh_room = mesh_room_},
                               {});
            });
            times.upload.time([&] {
                while (cells_.shown() != set)
                    cells_.upload(set, std::numeric_limits<std::size_t>::max(), volume);
            });
            draw(pass_, footprint);
        });
        times.cells.push_back(static_cast<double>(set->cells()));
        if (is_blended(footprint))
            times.order.time([&] { make_orders(); });
        const std::optional<float> radius = radius_of(footprint, shapes_);
        if (radius) {
            set_bare(*radius, is_blended(footprint));
            draw(as_quads_, footprint); // sorts
        }
        times.draw.time([&] { draw(pass_, footprint); });
        if (radius) {
            times.quads.time([&] { draw(as_quads_, footprint); });
            times.bare.time([&] { draw_bare(footprint); });
        }
        if (vtk_) {
            times.vtk.time([&] {
                vtk_->draw(query);
                gl_.Finish();
            });
            gl_.Disable(GL_SCISSOR_TEST);
        }
    }

    void draw_bare(Footprint footprint) {
        target_.bind();
        target_.clear(kBackground);
        if (!is_blended(footprint) || !look_.linear_light)
            gl_.Disable(GL_FRAMEBUFFER_SRGB); // as the pass does, as its colors need no conversion
        bare_.draw(camera_.views, is_blended(footprint));
        gl_.Finish();
    }

    render::TraversalKey key_of(const render::View& view) const {
        const glm::mat4 index_from_eye =
            glm::inverse(view.eye_from_room * camera_.placement.room_from_index);
        const glm::vec3 spacing(file_->info().grid.spacing);
        return render::traversal_key(index_from_eye[3], glm::ivec3(camera_.placement.extent),
                                     spacing);
    }

    /// Sorts the cells, as the pass does in the frame that shows a new set.
    void make_orders() {
        for (const render::View& view : camera_.views)
            orders_.texture(cells_, key_of(view));
        gl_.Finish();
    }

    void set_bare(float radius, bool blended) {
        for (std::size_t i = 0; i < camera_.views.size(); ++i) {
            std::vector<std::uint32_t> order;
            if (blended)
                render::order_back_to_front(cells_.slots(), key_of(camera_.views[i]), order);
            bare_.set(i, projected_corners(camera_.views[i], camera_.placement, radius,
                                           cells_.slots().places, order));
        }
    }

    /// Time plays and the isovalue is dragged to and fro, with extraction on its own thread. Each
    /// frame is compared with draws of the same cells.
    void play(Footprint footprint, std::size_t frames, RenderRow& row,
              const std::function<void(double)>& progress) {
        constexpr int kStatic = 3;
        constexpr double kDragged = 0.1; ///< share of the isovalue
        // With enough frames the 99th percentile is not just the worst one; only if that is fast.
        constexpr std::size_t kManyFrames = 500;
        const auto steps = static_cast<std::uint32_t>(file_->info().steps());
        const render::SendVolume volume = volume_for(footprint);
        index::Extractor extractor(extract_);
        const std::uint64_t mesh_room = footprint == Footprint::mesh ? kPlentyOfRoom : 0;
        std::vector<double> over, noise;
        const double start = wall_ms();
        const auto enough = [&](std::size_t i) {
            return i >= frames && (i >= kManyFrames || wall_ms() - start > options_.motion_ms);
        };
        for (std::size_t i = 0; !enough(i); ++i) {
            progress(std::min(static_cast<double>(i) / static_cast<double>(frames), 1.0));
            const auto step = static_cast<std::uint32_t>(i % steps);
            const double turn = static_cast<double>(i) / 40.0;
            const double isovalue =
                options_.isovalue * (1.0 + kDragged * std::sin(2.0 * std::numbers::pi * turn));
            Frames frame, still;
            frame.time([&] {
                extractor.request({{.instant = index::Instant(step),
                                    .isovalues = {isovalue},
                                    .mesh_room = mesh_room},
                                   index::StepsAhead{(step + 1) % steps}});
                cells_.upload(extractor.newest(), kUploadBytes, volume);
                draw(pass_, footprint);
            });
            extractor.wait();
            for (int k = 0; k < kStatic; ++k)
                still.time([&] { draw(pass_, footprint); });
            over.push_back(frame.ms() / still.ms());
            noise.push_back(still.all_ms().back() / still.ms());
        }
        row.p99_over_static = percentile(over, 99);
        row.worst_over_static = *std::max_element(over.begin(), over.end());
        row.static_p99_over_static = percentile(noise, 99);
    }

    const render::Gl& gl_;
    std::shared_ptr<const index::IndexFile> file_;
    const RenderOptions& options_;
    Picture picture_;
    render::FootprintShapes shapes_;
    render::CellAppearance look_;
    BenchCamera camera_;
    SwayingViews swaying_{camera_.views};
    render::RenderTarget target_;
    render::CellPass pass_, as_quads_;
    render::CellBuffers cells_;
    render::OrderCache orders_;
    BareQuads bare_;
    index::Extract extract_ =
        index::extract_from(file_, std::nullopt, render::CellBuffers::wanted_shading(gl_));
    std::uint64_t mesh_room_ = 0; ///< as a session's: only where meshes are drawn
    std::unique_ptr<VtkScene> vtk_;
};

} // namespace

const std::vector<NamedFootprint>& all_footprints() {
    static const std::vector<NamedFootprint> footprints{{"quad", Footprint::quad},
                                                        {"gaussian", Footprint::gaussian},
                                                        {"mesh", Footprint::mesh},
                                                        {"surface", Footprint::surface}};
    return footprints;
}

double percentile(std::vector<double> numbers, double percent) {
    const double last = static_cast<double>(numbers.size() - 1);
    const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(std::ceil(last * percent / 100));
    std::nth_element(numbers.begin(), at, numbers.end());
    return *at;
}

std::vector<RenderRow> measure_rendering(const std::shared_ptr<const index::IndexFile>& file,
                                         const RenderOptions& options,
                                         const index::Progress& progress) {
    const auto context = stereo::make_context(options.context, {.size = {16, 16}, .vsync = false});
    const render::Gl gl(context->loader());
    const std::optional<double> sent_ids = sent_ids_percent(gl, file, options.isovalue);
    std::vector<RenderRow> rows;
    for (const Picture& picture : options.pictures) {
        Bench bench(gl, file, options, picture);
        for (const NamedFootprint& footprint : options.footprints)
            rows.push_back(bench.measure(footprint, [&](double fraction) {
                progress(fmt::format("{} {}, {} x {}, {} threads, {}", options.data, footprint.name,
                                     picture.eyes, picture.size, options.threads,
                                     stereo::name_of(options.context)),
                         fraction);
            }));
    }
    for (RenderRow& row : rows)
        row.sent_ids_percent = sent_ids;
    return rows;
}

} // namespace isochron::bench
