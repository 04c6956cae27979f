// `isochron verify`: whether an index is intact.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/subcommands.h"
#include "app/indexing/open_index.h"
#include "app/telling.h"
#include "index/error.h"
#include "index/file/index_file.h"
#include "index/file/index_states.h"

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <memory>

namespace isochron::app {
namespace {

using Json = nlohmann::ordered_json;

void run_verify(const std::filesystem::path& path) {
    const CancelOnSignal signals;
    std::error_code ignored;
    const bool there = std::filesystem::exists(path, ignored);
    tell_result({{"file", path.string()}, {"intact", there ? Json(false) : Json()}}); // for now
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
    tell_result({{"intact", true},
                 {"file_bytes", file->stats().file_bytes},
                 {"sources_checked", file->referral().has_value()}});
    print_report("{}: every checksum matches{}\n", path.string(),
                 file->referral() ? ", in its sources too" : "");
}

} // namespace

void add_verify(Command& program) {
    auto path = std::make_shared<std::filesystem::path>();
    Command command = program.subcommand(
        "verify", "Check every checksum of an index, which reads the whole file.");
    command.examples(
        {"isochron verify run42.isochron", "isochron verify run42.isochron && echo intact"});
    command.option("file INDEX", *path, "Index to check").required();
    command.footer("If the index refers to files instead of holding their values, these files are "
                   "checked, too. One line says where the damage is.");
    command.exit_status(0, "intact");
    command.exit_status(1, "damaged");
    command.on_run([path] { run_verify(*path); });
}

} // namespace isochron::app
