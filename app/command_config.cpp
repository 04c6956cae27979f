// `isochron config`: configurations from other programs' files.
#include "app/check_config.h"
#include "app/commands.h"
#include "app/display_config_text.h"
#include "app/file_patterns.h"
#include "app/positive_number.h"
#include "app/pvx_file.h"
#include "index/new_file.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <span>

namespace isochron::app {
namespace {

struct ImportOptions {
    std::string file;
    std::optional<std::string> out;
    PvxOptions pvx;
    std::vector<float> origin;
};

void import(ImportOptions options) {
    if (!options.origin.empty())
        options.pvx.origin = {options.origin[0], options.origin[1], options.origin[2]};
    const PvxImport imported = read_pvx(options.file, options.pvx);
    for (const std::string& note : imported.notes)
        fmt::print(stderr, "note: {}\n", note);
    const std::string text =
        "# Imported from a .pvx file of ParaView.\n" + display_config_text(imported.installation);
    const Config config = parse_config(text, options.out.value_or("the imported configuration"));
    for (const ConfigProblem& problem : problems_of(config))
        fmt::print(stderr, "{}\n", line_of(problem, config));
    if (!options.out) {
        fmt::print("{}", text);
        return;
    }
    refuse_input_as_output({options.file}, *options.out);
    index::NewFile file(*options.out);
    file.write_at(0, std::as_bytes(std::span(text)));
    file.commit();
}

} // namespace

void add_config(CLI::App& program) {
    CLI::App* config =
        program.add_subcommand("config", "Make configurations from other programs' files.");
    config->require_subcommand(1);
    auto options = std::make_shared<ImportOptions>();
    CLI::App* command = config->add_subcommand(
        "import", "Write what ParaView's .pvx file describes as a TOML configuration.");
    command->add_option("file", options->file, "ParaView's description of a CAVE (.pvx)")
        ->required();
    command->add_option("-o,--out", options->out,
                        "Configuration to write (default: to the terminal)");
    command
        ->add_option("--unit", options->pvx.metres_per_unit,
                     "Metres per unit of the file: 0.3048 for feet, 0.001 for millimetres")
        ->check(positive_number())
        ->capture_default_str();
    command
        ->add_option("--origin", options->origin,
                     "Where the file's origin is in the room, metres: 0 1.6 0 where corners are "
                     "given from the eyes")
        ->expected(3);
    command->footer("Exit status: 0 done, 1 bad input, 2 bad usage.");
    command->callback([options] { import(*options); });
}

} // namespace isochron::app
