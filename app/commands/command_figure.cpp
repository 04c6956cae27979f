// `isochron figure`: a page of one to four panels for a paper.
#include "app/command_line/subcommands.h"
#include "app/explore/figure_page.h"
#include "app/output/guarded_outputs.h"
#include "app/telling.h"
#include "index/system/new_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

struct FigureOptions {
    std::string file, out, context = "egl";
    bool force = false;
};

void write_figure(const FigureOptions& options) {
    constexpr std::array kFormats{".pdf", ".png", ".tif", ".tiff"};
    const fs::path out(options.out);
    if (std::ranges::find(kFormats, out.extension().string()) == kFormats.end())
        throw UsageError("--output: expected a name that ends in .pdf, .png, .tif or .tiff, got {}",
                         options.out);
    const FigureFile figure = read_figure(options.file);
    std::vector<fs::path> data;
    Reads reads{{options.file}, nullptr};
    const fs::path folder = fs::path(options.file).parent_path();
    for (const FigurePanel& panel : figure.panels) {
        data.push_back(folder / panel.index);
        reads.files.push_back(data.back());
    }
    for (const auto& [name, text] : figure.texts)
        reads.files.push_back(folder / name);
    guard_outputs({{out, OutputKind::picture}}, reads, options.force);
    const MadeFigure made =
        make_figure(figure, options.file, data, *stereo::context_kind_from_name(options.context));
    index::write_file(out, figure_bytes(made, figure.dpi, out));
    tell_result({{"file", options.out},
                 {"panels", figure.panels.size()},
                 {"width_mm", made.page.size.x},
                 {"height_mm", made.page.size.y},
                 {"dpi", figure.dpi}});
    print_report("wrote {}: {} panel{}, {:.4g} x {:.4g} mm, {:g} dpi\n", options.out,
                 figure.panels.size(), figure.panels.size() == 1 ? "" : "s", made.page.size.x,
                 made.page.size.y, figure.dpi);
}

} // namespace

void add_figure(Command& program) {
    auto options = std::make_shared<FigureOptions>();
    Command command = program.subcommand(
        "figure", "Write a figure for a paper: a page of one to four panels, as PDF, PNG or TIFF.");
    command.examples({"isochron figure figure.toml -o figure.pdf",
                      "isochron figure figure.toml -o figure.tiff"});
    command
        .option("file FILE", options->file,
                "What the figure shows: a TOML file (docs/guide/figures.md)")
        .required();
    command
        .option("-o,--output FILE", options->out,
                "Figure to write: .pdf, with its words as text, .png or .tiff")
        .required();
    command.option("--context CONTEXT", options->context, "OpenGL context to draw with")
        .one_of({"egl", "osmesa"})
        .shows_default();
    command.flag("--force", options->force,
                 "Let --output replace any file but one that is read; without this option it "
                 "replaces only figures and pictures of this program");
    command.footer("`isochron reproduce figure.pdf` makes the figure again and compares both.");
    command.on_run([options] { write_figure(*options); });
}

} // namespace isochron::app
