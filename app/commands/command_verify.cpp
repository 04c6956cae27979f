// `isochron verify`: whether an index is intact.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/subcommands.h"
#include "app/indexing/open_index.h"
#include "app/safe_text.h"
#include "index/error.h"
#include "index/file/index_file.h"
#include "index/file/index_states.h"

#include <fmt/format.h>

#include <unistd.h>

#include <memory>

namespace isochron::app {
namespace {

void run_verify(const std::filesystem::path& path) {
    const CancelOnSignal signals;
    const auto file = open_index(path, 0, LostState::is_for_the_caller);
    {
        ProgressBar bar(stderr, static_cast<double>(file->stats().file_bytes));
        file->verify([&](std::string_view phase, double fraction) {
            signals.check();
            if (isatty(STDERR_FILENO))
                bar.show(phase, fraction);
        });
    }
    if (const auto lost = index::lost_state(*file))
        throw index::Error(*lost);
    print_safely("{}: every checksum matches{}\n", path.string(),
                 file->referral() ? ", in its sources too" : "");
}

} // namespace

void add_verify(Command& program) {
    auto path = std::make_shared<std::filesystem::path>();
    Command command = program.subcommand(
        "verify", "Check every checksum of an index; this reads the whole file.");
    command.examples(
        {"isochron verify run42.isochron", "isochron verify run42.isochron && echo intact"});
    command.option("file", *path, "Index").required().type_name("NAME.isochron");
    command.footer(
        "If the index refers to its source files, they are read too. Exit status: 0 intact, "
        "1 damaged, and one line that says where.");
    command.on_run([path] { run_verify(*path); });
}

} // namespace isochron::app
