// Compares pictures of footprints with those of the exact surface.
#include "tests/bench/measures/agreement.h"

#include "index/extraction/extraction.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/driver.h"
#include "render/gl/render_target.h"
#include "render/gl/srgb.h"
#include "stereo/context/gl_context.h"
#include "tests/bench/measures/render_camera.h"
#include "tests/bench/measures/stopwatch.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace isochron::bench {

namespace {

using render::Footprint;
using render::Image;

constexpr int kTimedDraws = 15;

/// Size of the picture with which a voxel in the volume's middle has `pixels_per_voxel` [pixel].
int picture_size(const index::SeriesInfo& info, double pixels_per_voxel) {
    const BenchCamera camera = bench_camera(info, 1000, 1);
    const render::View& view = camera.views[0];
    const glm::vec3 spacing = camera.placement.spacing();
    const double voxel = std::cbrt(double{spacing.x} * spacing.y * spacing.z);
    const glm::vec4 middle = view.eye_from_room * camera.placement.room_from_index *
                             glm::vec4(0.5f * camera.placement.extent, 1.0f);
    const double across =
        2.0 * -double{middle.z} * std::tan(glm::radians(0.5 * BenchCamera::kAngle));
    return static_cast<int>(std::lround(pixels_per_voxel * across / voxel));
}

bool is_lit(const Image& image, int x, int y) {
    return image.at(x, y)[3] >= 128;
}

glm::vec3 display(const Image& image, int x, int y) {
    const std::uint8_t* const p = image.at(x, y);
    return glm::vec3(p[0], p[1], p[2]) / 255.0f;
}

double luminance(const Image& image, int x, int y) {
    return double{glm::dot(render::linear_from_srgb(display(image, x, y)),
                           glm::vec3(0.2126f, 0.7152f, 0.0722f))};
}

/// Length of the silhouette's outline [pixels], by the Cauchy-Crofton formula from the number of
/// times that rows and columns cross it.
double outline_length(const Image& image) {
    double crossings = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const bool lit = is_lit(image, x, y);
            crossings += x + 1 < image.width && is_lit(image, x + 1, y) != lit;
            crossings += y + 1 < image.height && is_lit(image, x, y + 1) != lit;
        }
    return 0.25 * std::numbers::pi * crossings;
}

void compare(const Image& exact, const Image& other, AgreementRow& row) {
    double lit = 0, extra = 0, missed = 0, both = 0, light = 0, light_off = 0, display_off = 0;
    for (int y = 0; y < exact.height; ++y)
        for (int x = 0; x < exact.width; ++x) {
            const bool a = is_lit(exact, x, y), b = is_lit(other, x, y);
            lit += a;
            extra += b && !a;
            missed += a && !b;
            if (!a || !b)
                continue;
            ++both;
            light += luminance(exact, x, y);
            light_off += std::abs(luminance(exact, x, y) - luminance(other, x, y));
            const glm::vec3 off = glm::abs(display(exact, x, y) - display(other, x, y));
            display_off += double{off.x + off.y + off.z} / 3.0;
        }
    row.exact_percent = 100.0 * lit / (static_cast<double>(exact.width) * exact.height);
    row.extra_percent = 100.0 * extra / lit;
    row.missed_percent = 100.0 * missed / lit;
    row.offset = (extra + missed) / outline_length(exact) / row.pixels_per_voxel;
    row.luminance_percent = 100.0 * light_off / light;
    row.display_percent = 100.0 * display_off / both;
}

class AgreementView {
  public:
    AgreementView(const render::Gl& gl, const index::SeriesInfo& info, double pixels_per_voxel)
        : gl_(gl), camera_(bench_camera(info, picture_size(info, pixels_per_voxel), 1)),
          target_(gl, camera_.views[0].size) {
        look_.linear_light = !render::draws_in_software(gl); // as in a session
    }

    Image draw(render::CellPass& pass, const render::CellBuffers& cells, Footprint footprint) {
        target_.bind();
        target_.clear({0, 0, 0, 0});
        pass.draw(camera_.views, camera_.placement, cells, footprint, look_);
        return target_.read();
    }

    double draw_ms(render::CellPass& pass, const render::CellBuffers& cells, Footprint footprint) {
        target_.bind();
        target_.clear({0, 0, 0, 0});
        gl_.Finish();
        const std::vector<render::View>& views = swaying_.next();
        const Stopwatch processors(Stopwatch::Of::all_threads);
        pass.draw(views, camera_.placement, cells, footprint, look_);
        gl_.Finish();
        return 1e3 * processors.seconds();
    }

  private:
    const render::Gl& gl_;
    BenchCamera camera_;
    SwayingViews swaying_{camera_.views};
    render::RenderTarget target_;
    render::CellAppearance look_;
};

} // namespace

std::vector<AgreementRow> measure_agreement(const std::shared_ptr<const index::IndexFile>& file,
                                            const AgreementOptions& options) {
    const auto context =
        stereo::make_context(stereo::ContextKind::egl, {.size = {16, 16}, .vsync = false});
    const render::Gl gl(context->loader());
    const index::Extract extract =
        index::extract_from(file, std::nullopt, render::CellBuffers::wanted_shading(gl));
    render::CellPass plane(gl), voxel(gl, {.shape = render::CellShape::voxel});
    std::vector<AgreementRow> rows;
    for (const double isovalue : options.isovalues) {
        const auto set = extract({index::Instant(options.step), {isovalue}}, {});
        render::CellBuffers cells(gl, file->info().grid);
        while (cells.shown() != set || !cells.has_volume())
            cells.upload(set, std::numeric_limits<std::size_t>::max());
        for (const double pixels : options.pixels_per_voxel) {
            AgreementView view(gl, file->info(), pixels);
            const Image exact = view.draw(plane, cells, Footprint::surface);
            for (const Footprint footprint : {Footprint::quad, Footprint::gaussian}) {
                std::array<std::vector<double>, 2> times;
                std::array<render::CellPass*, 2> passes{&voxel, &plane};
                std::array<AgreementRow, 2> pair;
                for (std::size_t i = 0; i < 2; ++i) {
                    AgreementRow& row = pair[i];
                    row.data = options.data;
                    row.footprint = name_of(footprint);
                    row.shape = name_of(i ? render::CellShape::plane : render::CellShape::voxel);
                    row.step = options.step;
                    row.isovalue = isovalue;
                    row.pixels_per_voxel = pixels;
                    row.cells = static_cast<double>(set->cells());
                    compare(exact, view.draw(*passes[i], cells, footprint), row);
                }
                for (int k = 0; k < kTimedDraws; ++k)
                    for (std::size_t i = 0; i < 2; ++i)
                        times[i].push_back(view.draw_ms(*passes[i], cells, footprint));
                for (std::size_t i = 0; i < 2; ++i) {
                    pair[i].draw_ms = *std::min_element(times[i].begin(), times[i].end());
                    rows.push_back(pair[i]);
                }
            }
        }
    }
    return rows;
}

} // namespace isochron::bench
