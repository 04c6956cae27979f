// `isochron manual` and `isochron completion`: manual pages and shell completions, made from the
// program's help.
#include "app/command_line/manual_pages.h"
#include "app/command_line/shell_completion.h"
#include "app/command_line/subcommands.h"
#include "app/version.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <span>

namespace isochron::app {

void add_manual(Command& program) {
    auto folder = std::make_shared<std::filesystem::path>();
    Command command = program.subcommand(
        "manual", "Write the manual pages of the program and of each command, for man(1).");
    command.option("folder", *folder, "Folder to write them to; made where it is missing")
        .required()
        .type_name("FOLDER");
    command.on_run([folder, program] {
        std::filesystem::create_directories(*folder);
        for (const ManualPage& page : manual_pages(program.reference(), std::string(kProgram))) {
            index::NewFile file(*folder / page.file);
            file.write_at(0, std::as_bytes(std::span(page.text)));
            file.commit();
        }
    });
}

void add_completion(Command& program) {
    auto shell = std::make_shared<std::string>();
    Command command = program.subcommand(
        "completion", "Print the script by which a shell completes commands and options.");
    command.option("shell", *shell, "Which shell's").required().one_of(completed_shells());
    command.footer("For one session of bash: source <(isochron completion bash). Installed "
                   "programs are completed without.");
    command.on_run(
        [shell, program] { fmt::print("{}", shell_completion(program.reference(), *shell)); });
}

} // namespace isochron::app
