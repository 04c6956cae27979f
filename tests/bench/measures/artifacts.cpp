// Measures the paper's two sources of error in pixels.
#include "tests/bench/measures/artifacts.h"

#include "index/scan/scan.h"
#include "index/search/id_sort.h"
#include "render/gl/render_target.h"
#include "tests/bench/measures/render_camera.h"
#include "tests/bench/measures/render_measure.h"
#include "tests/bench/rows/record_json.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace isochron::bench {

template <class AnyRow, class Field>
void each_field(AnyRow& row,
                Field&& field) requires std::is_same_v<std::remove_const_t<AnyRow>, ArtifactRow> {
    field("data", row.data);
    field("footprint", row.footprint);
    field("l", row.l);
    field("max_variation", row.max_variation);
    field("cells", row.cells);
    field("angle_mean", row.angle_mean);
    field("angle_p99", row.angle_p99);
    field("normals_mean", row.normals_mean);
    field("normals_p99", row.normals_p99);
    field("normals_changed_percent", row.normals_changed_percent);
    field("false_positive_percent", row.false_positive_percent);
    field("false_mean", row.false_mean);
    field("false_p99", row.false_p99);
    field("false_changed_percent", row.false_changed_percent);
}

namespace {

using index::CellSet;

/// Nothing is drawn where alpha is zero.
constexpr glm::vec4 kNothing(0.0f);

int difference_at(const std::uint8_t* a, const std::uint8_t* b) {
    int most = 0;
    for (int channel = 0; channel < 3; ++channel)
        most = std::max(most, std::abs(a[channel] - b[channel]));
    return most;
}

index::CellSetPtr shaded(const index::StepValues& values, const index::Query& query,
                         std::vector<index::CellId> ids) {
    auto set = std::make_shared<CellSet>();
    set->query = query;
    set->ids = std::move(ids);
    index::sort_ids(set->ids, values.grid.cell_count());
    index::shade_cells(values, *set);
    return set;
}

/// All footprints except the exact surface, which is drawn from the volume and so does not show
/// these errors.
const std::vector<NamedFootprint>& splats() {
    static const std::vector<NamedFootprint> footprints = [] {
        auto all = all_footprints();
        std::erase_if(all, [](const NamedFootprint& one) {
            return one.footprint == render::Footprint::surface ||
                   one.footprint == render::Footprint::mesh;
        });
        return all;
    }();
    return footprints;
}

} // namespace

std::string to_json_text(const ArtifactResults& results) {
    return results_text(results);
}

PixelDifference difference(const render::Image& a, const render::Image& b) {
    std::vector<double> all;
    std::size_t changed = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        if (a.rgba[i + 3] == 0 && b.rgba[i + 3] == 0)
            continue;
        const int here = difference_at(&a.rgba[i], &b.rgba[i]);
        changed += here > PixelDifference::kVisible;
        all.push_back(here);
    }
    if (all.empty())
        return {};
    const double count = static_cast<double>(all.size());
    return {.mean = std::accumulate(all.begin(), all.end(), 0.0) / count,
            .p99 = percentile(all, 99),
            .changed_percent = 100.0 * static_cast<double>(changed) / count};
}

ArtifactSets artifact_sets(const index::StepValues& values, const index::ThiTree& tree,
                           const index::Query& query) {
    std::vector<index::CellId> active, found;
    index::scan(values, query, active);
    const index::KeyMap keys(values.type, values.scaling);
    tree.search(query.instant.step, keys.threshold(query.isovalue), found);
    ArtifactSets sets{shaded(values, query, active), nullptr, shaded(values, query, found)};

    auto kept = std::make_shared<CellSet>(*sets.exact);
    for (const SpanCells& span : span_cells(values, tree, query)) {
        const auto stored =
            shaded(values, {index::Instant(span.middle), query.isovalue}, span.cells);
        for (std::size_t i = 0; i < stored->ids.size(); ++i) {
            const auto at = std::lower_bound(kept->ids.begin(), kept->ids.end(), stored->ids[i]);
            std::uint32_t& plane =
                kept->points[static_cast<std::size_t>(at - kept->ids.begin())].plane;
            plane = (plane & ~index::kNormalBits) | (stored->points[i].plane & index::kNormalBits);
        }
    }
    sets.kept_normals = std::move(kept);
    return sets;
}

ArtifactBench::ArtifactBench(const render::Gl& gl, std::shared_ptr<const index::IndexFile> file,
                             int size)
    : gl_(gl), file_(std::move(file)), size_(size), pass_(gl) {}

render::Image ArtifactBench::draw(const index::CellSetPtr& set, render::Footprint footprint) {
    const BenchCamera camera = bench_camera(file_->info(), size_, 1);
    const render::RenderTarget target(gl_, {size_, size_});
    const auto cells = render::CellBuffers::of_points(gl_, set->points);
    target.bind();
    target.clear(kNothing);
    pass_.draw(camera.views, camera.placement, cells, footprint);
    return target.read();
}

ArtifactPictures ArtifactBench::draw(const ArtifactSets& sets, render::Footprint footprint) {
    return {draw(sets.exact, footprint), draw(sets.kept_normals, footprint),
            draw(sets.false_positives, footprint)};
}

std::vector<ArtifactRow> ArtifactBench::measure(const std::string& data,
                                                const index::ThiOptions& options, double isovalue,
                                                std::uint32_t every,
                                                const index::Progress& progress) {
    const index::StepValues& values = file_->values();
    const auto bytes = index::build_thi_tree(values, options);
    const index::ThiTree tree(bytes);
    const NormalError angles = normal_error(values, tree, isovalue);
    std::vector<ArtifactRow> rows;
    for (const NamedFootprint& footprint : splats()) {
        ArtifactRow& row = rows.emplace_back();
        row.data = data;
        row.footprint = footprint.name;
        row.l = options.lattice;
        row.max_variation = options.max_variation;
        row.angle_mean = angles.mean_degrees;
        row.angle_p99 = angles.p99_degrees;
    }
    const auto steps = static_cast<std::uint32_t>(values.steps);
    const std::uint32_t measured = (steps + every - 1) / every;
    const double share = 1.0 / measured;
    for (std::uint32_t step = 0; step < steps; step += every) {
        progress(fmt::format("{} L {} MV {}", data, options.lattice, options.max_variation),
                 static_cast<double>(step) / steps);
        const ArtifactSets sets = artifact_sets(values, tree, {index::Instant(step), isovalue});
        const double active = static_cast<double>(sets.exact->ids.size());
        const double found = static_cast<double>(sets.false_positives->ids.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const ArtifactPictures pictures = draw(sets, splats()[i].footprint);
            const PixelDifference normals = difference(pictures.exact, pictures.kept_normals);
            const PixelDifference more = difference(pictures.exact, pictures.false_positives);
            ArtifactRow& row = rows[i];
            row.cells += share * active;
            row.normals_mean += share * normals.mean;
            row.normals_p99 += share * normals.p99;
            row.normals_changed_percent += share * normals.changed_percent;
            row.false_positive_percent += share * 100.0 * (found - active) / std::max(active, 1.0);
            row.false_mean += share * more.mean;
            row.false_p99 += share * more.p99;
            row.false_changed_percent += share * more.changed_percent;
        }
    }
    return rows;
}

render::Image side_by_side(const std::vector<render::Image>& pictures) {
    render::Image all;
    all.height = pictures.front().height;
    for (const render::Image& picture : pictures)
        all.width += picture.width;
    for (int y = 0; y < all.height; ++y)
        for (const render::Image& picture : pictures)
            all.rgba.insert(all.rgba.end(), picture.at(0, y), picture.at(0, y) + 4 * picture.width);
    return all;
}

render::Image difference_picture(const render::Image& a, const render::Image& b, int gain) {
    render::Image picture = a;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        const int gray = std::min(gain * difference_at(&a.rgba[i], &b.rgba[i]), 255);
        std::fill_n(picture.rgba.begin() + static_cast<std::ptrdiff_t>(i), 3,
                    static_cast<std::uint8_t>(gray));
        picture.rgba[i + 3] = 255;
    }
    return picture;
}

} // namespace isochron::bench
