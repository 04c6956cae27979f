// `isochron manual` and `isochron completion`: manual pages and shell completions, made from the
// program's help.
#include "app/command_line/manual_pages.h"
#include "app/command_line/shell_completion.h"
#include "app/command_line/subcommands.h"
#include "app/output/guarded_outputs.h"
#include "app/safe_text.h"
#include "app/version.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace isochron::app {

void add_manual(Command& program) {
    struct Options {
        std::filesystem::path folder;
        bool force = false;
    };
    auto options = std::make_shared<Options>();
    Command command = program.subcommand(
        "manual", "Write the manual pages of the program and of each command, for man(1).");
    command.examples({"isochron manual ~/.local/share/man/man1", "isochron manual pages --force"});
    command.option("folder", options->folder, "Folder to write them to; made where it is missing")
        .required()
        .type_name("FOLDER");
    command.flag("--force", options->force,
                 "Replace any files of the pages' names; else only such pages are replaced");
    command.on_run([options, program] {
        const auto pages = manual_pages(program.reference(), std::string(kProgram));
        std::vector<Output> outputs;
        for (const ManualPage& page : pages)
            outputs.push_back({options->folder / page.file, OutputKind::manual_page});
        guard_outputs(outputs, {}, options->force);
        std::filesystem::create_directories(options->folder);
        for (const ManualPage& page : pages) {
            index::NewFile file(options->folder / page.file);
            file.write_at(0, std::as_bytes(std::span(page.text)));
            file.commit();
        }
    });
}

void add_completion(Command& program) {
    auto shell = std::make_shared<std::string>();
    Command command = program.subcommand(
        "completion", "Print the script by which a shell completes commands and options.");
    command.examples({"source <(isochron completion bash)", "isochron completion zsh > _isochron"});
    command.option("shell", *shell, "Which shell's").required().one_of(completed_shells());
    command.footer("For one session of bash: source <(isochron completion bash). Installed "
                   "programs are completed without.");
    command.on_run([shell, program] {
        print_safely(SafeText::lines(shell_completion(program.reference(), *shell)));
    });
}

} // namespace isochron::app
