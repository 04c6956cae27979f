// `isochron generate`: starts the program that makes the demo series, which alone needs FFTW.
#include "app/command_line/subcommands.h"
#include "app/generate/generate_options.h"
#include "index/error.h"
#include "index/system/module.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

const char* const kProgramOfSeries = "isochron-generate";

/// Turns this process into the other program: signals, terminal and exit status are its own then.
/// @throws index::Error if it cannot be started
[[noreturn]] void become_program_of_series(const Command& command) {
    const std::string file = index::file_of_program(kProgramOfSeries).string();
    std::vector<std::string> words = command.typed();
    std::vector<char*> arguments{const_cast<char*>(kProgramOfSeries)};
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    ::execv(file.c_str(), arguments.data());
    throw index::Error("{}: cannot be started: {}", file, std::strerror(errno));
}

} // namespace

void add_generate(Command& program) {
    add_generate_options(program, [](const Command& command, const DemoRequest&) {
        become_program_of_series(command);
    });
}

} // namespace isochron::app
