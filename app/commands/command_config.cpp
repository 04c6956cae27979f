// `isochron config`: configurations from other programs' files, and what a configuration may hold.
#include "app/command_line/subcommands.h"
#include "app/config/check_config.h"
#include "app/config/display_config_text.h"
#include "app/config/pvx_file.h"
#include "app/output/guarded_outputs.h"
#include "app/telling.h"
#include "index/system/new_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

struct ImportOptions {
    std::string file;
    std::optional<std::string> out;
    PvxOptions pvx;
    std::vector<float> origin;
    bool force = false;
};

/// A .pvx file tells who looks, and not what tracks them.
bool asks_for_tracker(const ConfigProblem& problem) {
    return problem.key == "viewers.head";
}

/// Checks an imported configuration as it will be checked when it is used. Messages leave line
/// numbers out, as the lines differ from the lines of the imported file.
Config sound_config(const std::string& text, const std::string& source,
                    const stereo::Installation& installation) {
    const std::string name = "import";
    try {
        Config config = parse_config(text, name);
        config.name = source;
        config.text.clear(); // it is not the text of the source
        config.installation = installation;
        for (const ConfigProblem& problem : problems_of(config))
            if (problem.wrong && !asks_for_tracker(problem))
                throw ConfigError(line_of(problem, config));
        return config;
    } catch (const ConfigError& error) {
        const std::string what = error.what();
        if (!what.starts_with(name + ":"))
            throw;
        throw ConfigError("{}{}", source, what.substr(what.find(": ")));
    }
}

void import(ImportOptions options) {
    if (!options.origin.empty())
        options.pvx.origin = {options.origin[0], options.origin[1], options.origin[2]};
    const PvxImport imported = read_pvx(options.file, options.pvx);
    const std::string text =
        "# Imported from a .pvx file of ParaView.\n" + display_config_text(imported.installation);
    const Config config = sound_config(text, options.file, imported.installation);
    if (options.out) {
        guard_outputs({{*options.out, OutputKind::configuration, 0, text}}, {{options.file}},
                      options.force);
        index::write_file(*options.out, text);
        tell_result({{"file", *options.out}});
    } else {
        tell_result({{"configuration", text}});
        print_answer(SafeText::data(text));
    }
    std::vector<std::string> notes;
    for (const std::string& note : imported.notes)
        notes.push_back("note: " + note);
    for (const ConfigProblem& problem : problems_of(config))
        notes.push_back(asks_for_tracker(problem)
                            ? fmt::format("note: {}: {}: its table is to be added "
                                          "(docs/guide/trackers.md)",
                                          config.name, problem.text)
                            : line_of(problem, config));
    tell_result({{"notes", notes}});
    for (const std::string& note : notes)
        print_note("{}", note);
}

} // namespace

void add_config(Command& program) {
    Command config = program.subcommand(
        "config",
        "Convert configurations of other programs, or print the schema of configurations.");
    config.examples({"isochron config import cave.pvx -o my-cave.toml",
                     "isochron config schema > isochron.schema.json"});
    config.require_subcommand();
    auto options = std::make_shared<ImportOptions>();
    Command command =
        config.subcommand("import", "Convert ParaView's .pvx file to a TOML configuration.");
    command.examples(
        {"isochron config import cave.pvx -o my-cave.toml",
         "isochron config import cave.pvx -o in-feet.toml --unit 0.3048 --origin 0 1.6 0"});
    command.option("file FILE", options->file, "Description of a CAVE that ParaView reads (.pvx)")
        .required();
    command.option("-o,--output,--out FILE", options->out,
                   "Configuration to write (default: print it)");
    command.flag("--force", options->force,
                 "Let --output replace any file but the .pvx file; without this option it replaces "
                 "only the same configuration");
    command
        .option("--unit METERS", options->pvx.meters_per_unit,
                "Length of the file's unit: 0.3048 for feet, 0.001 for millimeters")
        .positive()
        .shows_default();
    command.option("--origin METERS METERS METERS", options->origin,
                   "Position in the room of the file's origin; 0 1.6 0 if the file's corners are "
                   "relative to the eyes");
    command.on_run([options] { import(*options); });
    Command schema = config.subcommand(
        "schema",
        "Print the JSON schema of configurations, with which editors check and complete files.");
    schema.examples({"isochron config schema", "isochron config schema > isochron.schema.json"});
    schema.on_run([] {
        tell_result(nlohmann::ordered_json::parse(config_schema()));
        print_answer(SafeText::data(config_schema()));
    });
}

} // namespace isochron::app
