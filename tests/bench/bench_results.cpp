// `isochron-bench results`: writes the page of results.
#include "app/command_line/command_line.h"
#include "index/error.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/pages/results_page.h"
#include "tests/bench/text_file.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <memory>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw index::Error(fmt::format("{}: cannot be read", path.string()));
    return {std::istreambuf_iterator<char>(file), {}};
}

struct ResultFiles {
    fs::path index, render, artifacts, scale, gpu, agreement, motion, building, change, between,
        public_files, out;
};

void run_bench_results(const ResultFiles& files) {
    const ResultsPage page = whole_page({.index = files.index.string(),
                                         .render = files.render.string(),
                                         .artifacts = files.artifacts.string(),
                                         .scale = files.scale.string(),
                                         .gpu = files.gpu.string(),
                                         .agreement = files.agreement.string(),
                                         .motion = files.motion.string(),
                                         .building = files.building.string(),
                                         .change = files.change.string(),
                                         .between = files.between.string(),
                                         .public_files = files.public_files.string()},
                                        read_text);
    if (files.out.empty()) {
        fmt::print("{}", page.text);
        return;
    }
    for (const auto& [name, chart] : page.charts) {
        const fs::path path = files.out.parent_path() / name;
        fs::create_directories(path.parent_path());
        write_text(path, chart);
    }
    write_text(files.out, page.text);
}

} // namespace

void add_results(app::Command& program) {
    auto files = std::make_shared<ResultFiles>();
    app::Command command = program.subcommand(
        "results", "Render what the other benchmarks wrote as a page next to the paper's tables.");
    command.option("json", files->index, "Results of `isochron-bench index --json`")
        .required()
        .type_name("FILE.json");
    command.option("--render", files->render, "Results of `isochron-bench render --json`")
        .type_name("FILE.json");
    command.option("--artifacts", files->artifacts, "Results of `isochron-bench artifacts --json`")
        .type_name("FILE.json");
    command.option("--scale", files->scale, "What `isochron-bench scale` printed")
        .type_name("FILE.txt");
    command.option("--gpu", files->gpu, "What programs printed where a GPU drew")
        .type_name("FILE.txt");
    command
        .option("--agreement", files->agreement,
                "Results of `isochron-bench render --agreement-only --json`")
        .type_name("FILE.json");
    command.option("--motion", files->motion, "Results of `isochron-bench motion --json`")
        .type_name("FILE.json");
    command.option("--building", files->building, "Results of `isochron-bench building --json`")
        .type_name("FILE.json");
    command.option("--change", files->change, "Results of `isochron-bench change --json`")
        .type_name("FILE.json");
    command.option("--between", files->between, "Results of `isochron-bench between --json`")
        .type_name("FILE.json");
    command
        .option("--public", files->public_files,
                "What tests/index/conformance/public.py printed of public files")
        .type_name("FILE.txt");
    command
        .option(
            "-o,--out", files->out,
            "Markdown to write, with its charts in pictures/charts beside it (default: print the "
            "page)")
        .type_name("FILE.md");
    command.on_run([files] { run_bench_results(*files); });
}

} // namespace isochron::bench
