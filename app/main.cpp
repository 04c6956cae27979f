// The program: parses the command line, runs one subcommand, turns errors into one line.
#include "app/cancel.h"
#include "app/commands.h"
#include "app/version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>

namespace app = isochron::app;

namespace {

int fail(const std::string& what, int status) {
    std::fprintf(stderr, "isochron: %s\n", what.c_str());
    return status;
}

/// The parser's complaint in one line, with the command whose help explains more.
std::string complaint(const CLI::App& program, const CLI::ParseError& error) {
    const CLI::App* command = &program;
    std::string name = program.get_name();
    while (!command->get_subcommands().empty()) {
        command = command->get_subcommands().front();
        name += " " + command->get_name();
    }
    std::string what = error.what();
    // Of a command that it does not know, the parser says only that one is missing.
    const std::vector<std::string> unknown = command->remaining();
    const auto known = command->get_subcommands([](const CLI::App*) { return true; });
    if (!known.empty()) {
        std::vector<std::string> names;
        for (const CLI::App* candidate : known)
            names.push_back(candidate->get_name());
        what = fmt::format("{}, expected {}",
                           unknown.empty() ? what : fmt::format("{}: unknown", unknown.front()),
                           fmt::join(names, ", "));
    }
    return fmt::format("{} (see {} --help)", what, name);
}

} // namespace

int main(int argc, char** argv) {
    CLI::App program{"Explore time-varying volume data immersively.", "isochron"};
    program.set_version_flag("--version", std::string(app::kProgram));
    program.require_subcommand(1);
    program.set_help_all_flag("--help-all", "Print the help of every subcommand and exit");
    app::add_build(program);
    app::add_query(program);
    app::add_change(program);
    app::add_info(program);
    app::add_verify(program);
    app::add_explore(program);
    app::add_replay(program);
    app::add_generate(program);
    app::add_config(program);
    app::add_bench(program);
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& request) {
        return program.exit(request);
    } catch (const CLI::ParseError& error) {
        return fail(complaint(program, error), 2);
    } catch (const app::Cancelled& cancelled) {
        return fail(cancelled.what(), cancelled.status);
    } catch (const app::ReportedElsewhere&) {
        return 0;
    } catch (const app::UsageError& error) {
        return fail(error.what(), 2);
    } catch (const std::exception& error) {
        return fail(error.what(), 1);
    }
    // What was printed must have arrived: a full disk behind a pipe or a redirection is an error
    // too.
    if (std::fflush(stdout) != 0)
        return fail("the output cannot be written", 1);
    return 0;
}
