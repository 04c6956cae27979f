// `isochron help`, `manual` and `completion`: help, manual pages and shell completions of all commands.
#include "app/command_line/manual_pages.h"
#include "app/command_line/shell_completion.h"
#include "app/command_line/subcommands.h"
#include "app/output/guarded_outputs.h"
#include "app/telling.h"
#include "app/version.h"
#include "index/system/new_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

nlohmann::ordered_json json_of(const CommandReference& command) {
    nlohmann::ordered_json options = nlohmann::ordered_json::array();
    for (const OptionReference& option : command.options)
        options.push_back({{"names", option.names},
                           {"value", option.value},
                           {"words", option.words},
                           {"help", option.help},
                           {"required", option.required}});
    nlohmann::ordered_json commands = nlohmann::ordered_json::array();
    for (const CommandReference& below : command.commands)
        commands.push_back(json_of(below));
    return {{"name", command.name},
            {"help", command.help},
            {"options", options},
            {"examples", command.examples},
            {"commands", commands}};
}

} // namespace

void add_help(Command& program) {
    auto words = std::make_shared<std::vector<std::string>>();
    Command command = program.subcommand("help", "Print the help of the program, or of a command.");
    command.examples({"isochron help", "isochron help generate sphere"});
    command.option("command COMMAND", *words, "Command, and the one below it, if any");
    command.on_run([words, program] {
        const std::string help = program.help(*words);
        CommandReference reference = program.reference();
        for (const std::string& word : *words) {
            CommandReference below =
                *std::ranges::find(reference.commands, word, &CommandReference::name);
            reference = std::move(below);
        }
        tell_result(json_of(reference));
        print_answer(SafeText::lines(help));
    });
}

void add_manual(Command& program) {
    struct Options {
        std::filesystem::path folder, output;
        bool force = false;
    };
    auto options = std::make_shared<Options>();
    Command command = program.subcommand(
        "manual", "Write the manual pages of the program and of all commands, for man(1).");
    command.examples(
        {"isochron manual -o ~/.local/share/man/man1", "isochron manual -o pages --force"});
    command.option("-o,--output FOLDER", options->output,
                   "Folder for the pages; it is made where it is missing");
    command.option("folder FOLDER", options->folder, "Former place of the folder").hidden();
    command.flag("--force", options->force,
                 "Replace any files that have the names of pages; without this option only manual "
                 "pages are replaced");
    command.on_run([options, program] {
        if (options->output.empty())
            options->output = options->folder;
        if (options->output.empty())
            throw UsageError("--output is required (see isochron manual --help)");
        const auto pages = manual_pages(program.reference(), std::string(kProgram));
        std::vector<Output> outputs;
        for (const ManualPage& page : pages)
            outputs.push_back({options->output / page.file, OutputKind::manual_page});
        guard_outputs(outputs, {}, options->force);
        std::filesystem::create_directories(options->output);
        nlohmann::ordered_json files = nlohmann::ordered_json::array();
        for (const ManualPage& page : pages) {
            index::write_file(options->output / page.file, page.text);
            files.push_back((options->output / page.file).string());
        }
        tell_result({{"files", files}});
        print_report("wrote {} manual pages in {}\n", pages.size(), options->output.string());
    });
}

void add_completion(Command& program) {
    auto shell = std::make_shared<std::string>();
    Command command = program.subcommand(
        "completion", "Print a script with which a shell completes commands and options.");
    command.examples({"source <(isochron completion bash)", "isochron completion zsh > _isochron"});
    command.option("shell SHELL", *shell, "Shell that the script is for")
        .required()
        .one_of(completed_shells());
    command.footer(
        "The first example completes in one session of bash. An installed program brings "
        "these scripts along.");
    command.on_run([shell, program] {
        const std::string script = shell_completion(program.reference(), *shell);
        tell_result({{"shell", *shell}, {"script", script}});
        print_answer(SafeText::lines(script));
    });
}

} // namespace isochron::app
