// `isochron-bench artifacts`: the effect of kept normals and false positives on pictures, and the
// paper's pair of renderings.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "stereo/context/gl_context.h"
#include "stereo/image_file.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/machine.h"
#include "tests/bench/measures/artifacts.h"
#include "tests/bench/measures/data_sets.h"
#include "tests/bench/measures/isovalues.h"
#include "tests/bench/measures/work_folder.h"
#include "tests/bench/text_file.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;

struct ArtifactArguments {
    fs::path json, pictures, work = fs::temp_directory_path();
    std::vector<std::string> data{"sphere-55", "vorticity"};
    std::vector<std::uint32_t> lattices{32, 64, 128}, max_variations{1, 2, 3};
    std::optional<std::size_t> steps;
    std::uint32_t every = 8;
    int size = 512;
    std::string context = "egl";
};

/// Writes the strips of pictures of one series, at a step in its middle.
void write_pictures(const fs::path& folder, const std::string& data,
                    const std::shared_ptr<const index::IndexFile>& file, double isovalue,
                    const index::ThiOptions& options, const render::Gl& gl) {
    constexpr int kSize = 320, kGain = 4;
    ArtifactBench bench(gl, file, kSize);
    const index::StepValues& values = file->values();
    const auto bytes = index::build_thi_tree(values, options);
    const index::Query query{
        index::Instant(static_cast<std::uint32_t>(values.steps / 2 - values.steps / 8)), isovalue};
    const ArtifactSets sets = artifact_sets(values, index::ThiTree(bytes), query);
    const ArtifactPictures splats = bench.draw(sets, render::Footprint::gaussian);
    const auto write = [&](const char* what, const std::vector<render::Image>& pictures) {
        stereo::write_image(side_by_side(pictures), folder / fmt::format("{}_{}.png", data, what));
    };
    write("quality_fast", {splats.exact, bench.draw(sets.exact, render::Footprint::quad)});
    write("kept_normals", {splats.exact, splats.kept_normals,
                           difference_picture(splats.exact, splats.kept_normals, kGain)});
    write("false_positives", {splats.exact, splats.false_positives,
                              difference_picture(splats.exact, splats.false_positives, kGain)});
}

void run_bench_artifacts(const ArtifactArguments& arguments) {
    const app::CancelOnSignal signals;
    const WorkFolder folder(arguments.work);
    const auto context = stereo::make_context(*stereo::context_kind_from_name(arguments.context),
                                              {.size = {16, 16}});
    const render::Gl gl(context->loader());
    ArtifactResults results{this_machine(), {}};
    app::ProgressBar bar;
    const index::Progress progress = [&](std::string_view phase, double fraction) {
        signals.check();
        bar.show(phase, fraction);
    };
    for (const std::string& name : arguments.data) {
        const DataSet data = data_set(name, index::ValueType::u8, arguments.steps);
        const auto file = build_file(data, folder.path() / (name + ".isochron"), progress);
        const double isovalue =
            data.isovalue ? *data.isovalue : isovalue_with(file->values(), data.active_cells);
        ArtifactBench bench(gl, file, arguments.size);
        for (const std::uint32_t lattice : arguments.lattices)
            for (const std::uint32_t max_variation : arguments.max_variations)
                for (const ArtifactRow& row : bench.measure(data.name, {lattice, max_variation},
                                                            isovalue, arguments.every, progress)) {
                    fmt::print("{} {}, L {} MV {}: kept normals {:.3g} deg, {:.3g} of 255, {:.3g} "
                               "% of pixels; false positives {:.3g} % of cells, {:.3g} % of "
                               "pixels\n",
                               row.data, row.footprint, row.l, row.max_variation, row.angle_mean,
                               row.normals_mean, row.normals_changed_percent,
                               row.false_positive_percent, row.false_changed_percent);
                    std::fflush(stdout);
                    results.rows.push_back(row);
                }
        if (!arguments.json.empty())
            write_text(arguments.json, to_json_text(results));
        if (!arguments.pictures.empty())
            write_pictures(arguments.pictures, data.name, file, isovalue,
                           {arguments.lattices.front(), arguments.max_variations.back()}, gl);
    }
}

} // namespace

void add_artifacts(app::Command& program) {
    auto arguments = std::make_shared<ArtifactArguments>();
    app::Command command = program.subcommand(
        "artifacts", "Count the pixels that change where normals are kept over a time span, and "
                     "where false positives of the THI tree are drawn.");
    command.option("--json FILE", arguments->json, "Write the rows, with commit and processor");
    command
        .option("--out DIR", arguments->pictures,
                "Folder for pictures: ShellSplatting and fast quads; exact normals, kept "
                "normals and their difference, four times as bright; the same of false "
                "positives, all of the first L and the last MaxVariation")
        .existing_folder();
    command.option("--data", arguments->data, "Series to make and draw, u8")
        .one_of(data_names())
        .comma_separated()
        .shows_default();
    command.option("--steps", arguments->steps, "Steps of the series").between(1, 100000);
    command.option("--every", arguments->every, "Draw every so many of the steps")
        .between(1u, 100000u)
        .shows_default();
    command.option("--lattice", arguments->lattices, "SpanSpaceSize L of the trees")
        .between(1u, 4096u)
        .comma_separated()
        .shows_default();
    command.option("--max-variation", arguments->max_variations, "MaxVariation of the trees")
        .between(1u, 64u)
        .comma_separated()
        .shows_default();
    command.option("--size", arguments->size, "Pixels of the pictures, across and up")
        .between(16, 8192)
        .shows_default();
    command.option("--context", arguments->context, "GL context")
        .one_of({"egl", "osmesa"})
        .shows_default();
    command.option("--work DIR", arguments->work, "Folder for the series' files")
        .existing_folder()
        .shows_default();
    command.on_run([arguments] { run_bench_artifacts(*arguments); });
}

} // namespace isochron::bench
