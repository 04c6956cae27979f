// The command line, through CLI11; besides command_help.cpp the only source that includes it.
#include "app/command_line/command_line.h"

#include "index/json_mistake.h"

#include "app/command_line/cancel.h"
#include "app/command_line/command_help.h"
#include "app/command_line/memory_shortage.h"
#include "app/end_in_time.h"
#include "app/safe_text.h"
#include "app/telling.h"
#include "app/text.h"
#include "app/version.h"

#include "index/shell_word.h"
#include "index/system/links/link.h"
#include "index/system/memory_limit.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

#include <sys/resource.h>
#include <unistd.h>

namespace isochron::app {
namespace {

/// `, did you mean NEAR?` as the end of a message; empty if `near` is empty.
std::string meant(const std::string& near) {
    return near.empty() ? near : fmt::format(", did you mean {}?", near);
}

/// The message on a word that is none of `names`.
std::string unknown_word(const std::string& word, const std::vector<std::string>& names) {
    const std::string near = nearest_word(word, names);
    return fmt::format("{}: unknown{}", word,
                       near.empty() ? fmt::format(", expected {}", fmt::join(names, ", "))
                                    : meant(near));
}

/// `isochron build 'a b.vti' -o ab.isochron`: a command as a user types it in a shell.
std::string shell_line(std::string line, const std::vector<std::string>& words) {
    for (const std::string& word : words)
        line += " " + index::shell_word(word);
    return line;
}

} // namespace

Option& Option::required() {
    option_->required();
    return *this;
}

Option& Option::group(const std::string& heading) {
    option_->group(heading);
    return *this;
}

Option& Option::needs(const Option& other) {
    option_->needs(other.option_);
    return *this;
}

Option& Option::hidden() {
    option_->group("");
    return *this;
}

Option& Option::repeatable() {
    option_->allow_extra_args(false);
    return *this;
}

Option& Option::comma_separated() {
    option_->delimiter(',');
    return *this;
}

Option& Option::shows_default() {
    option_->capture_default_str();
    return *this;
}

template <class T>
Option& Option::between(T low, T high) {
    return accepted_by(
        [low, high](const std::string& text) {
            T value{};
            const bool good =
                CLI::detail::lexical_cast(text, value) && low <= value && value <= high;
            return good ? std::string() : fmt::format("expected {} to {}, got {}", low, high, text);
        },
        fmt::format("{} to {}", low, high));
}
template Option& Option::between(int, int);
template Option& Option::between(unsigned, unsigned);
template Option& Option::between(std::size_t, std::size_t);
template Option& Option::between(double, double);

Option& Option::one_of(const std::vector<std::string>& names,
                       const std::vector<std::string>& former) {
    return accepted_by(
        [names, former](const std::string& text) {
            if (std::ranges::find(names, text) != names.end() ||
                std::ranges::find(former, text) != former.end())
                return std::string();
            return fmt::format("expected one of {}, got {}{}", fmt::join(names, ", "), text,
                               meant(nearest_word(text, names)));
        },
        fmt::format("{{{}}}", fmt::join(names, ",")));
}

Option& Option::positive() {
    return accepted_by(
        [](const std::string& text) {
            double value = 0;
            const bool good = CLI::detail::lexical_cast(text, value) && value > 0;
            return good ? std::string() : fmt::format("expected a positive number, got {}", text);
        },
        "");
}

Option& Option::existing_file() {
    option_->check(CLI::Validator(CLI::ExistingFile).description(""));
    return *this;
}

Option& Option::existing_folder() {
    option_->check(CLI::Validator(CLI::ExistingDirectory).description(""));
    return *this;
}

Option& Option::accepted_by(std::function<std::string(const std::string&)> complaint,
                            const std::string& form) {
    option_->check(CLI::Validator(
        [complaint = std::move(complaint)](const std::string& text) { return complaint(text); },
        form.empty() ? form : kFormBegins + form));
    return *this;
}

bool Option::given() const {
    return option_->count() > 0;
}

namespace {

/// The flags that every command has; `set_telling` reads them.
constexpr std::pair<const char*, const char*> kTelling[] = {
    {"--json", "Print one JSON object in place of text; its keys: docs/guide/json.md"},
    {"--quiet", "Print no notes, no progress and no report of files written"},
    {"--verbose", "Also print on stderr what is opened and what the work took"}};

void add_telling_options(CLI::App& command) {
    const char* group = "Output";
    for (const auto& [name, help] : kTelling)
        command.add_flag_callback(name, [] {}, help)->group(group);
    command.set_help_flag("-h,--help", "Print this help")->group(group);
    if (CLI::Option* all = command.get_option_no_throw("--help-all"); all && command.get_parent())
        all->group(""); // told by the program
}

} // namespace

Command Command::subcommand(const std::string& name, const std::string& description) {
    CLI::App& added = *app_->add_subcommand(name, description);
    add_telling_options(added);
    return Command(added, *typed_);
}

void Command::require_subcommand() {
    app_->require_subcommand(1);
}

namespace {

/// What an option of type T takes, maybe several times.
template <class T>
struct Taken {
    using Value = T;
};
template <class T>
struct Taken<std::optional<T>> {
    using Value = T;
};
template <class T>
struct Taken<std::vector<T>> {
    using Value = T;
};

} // namespace

template <class T>
Option Command::option(const std::string& form, T& value, const std::string& help) {
    using Value = Taken<T>::Value;
    const std::size_t names_end = std::min(form.find(' '), form.size());
    const std::string names = form.substr(0, names_end);
    const std::string shown = form.substr(std::min(names_end + 1, form.size()));
    // A command's own option takes the place of one that every command has.
    if (std::ranges::find(kTelling, names, &std::pair<const char*, const char*>::first) !=
        std::end(kTelling))
        app_->remove_option(app_->get_option(names));
    CLI::Option& option = *app_->add_option(names, value, help);
    if (!shown.empty())
        option.type_name(shown);
    if (shown.starts_with('['))
        option.expected(0, 1);
    else if (const auto further = std::ranges::count(shown, ' '); further > 0)
        option.expected(static_cast<int>(further) + 1);
    Option added(option);
    if constexpr (std::is_floating_point_v<Value>)
        added.accepted_by(
            [](const std::string& text) {
                Value number{};
                const bool bad = CLI::detail::lexical_cast(text, number) && !std::isfinite(number);
                return bad ? fmt::format("expected a finite number, got {}", text) : std::string();
            },
            "");
    return added;
}
// One line for each type of value that options have.
template Option Command::option(const std::string&, std::filesystem::path&, const std::string&);
template Option Command::option(const std::string&, std::string&, const std::string&);
template Option Command::option(const std::string&, int&, const std::string&);
template Option Command::option(const std::string&, long&, const std::string&);
template Option Command::option(const std::string&, unsigned&, const std::string&);
template Option Command::option(const std::string&, std::size_t&, const std::string&);
template Option Command::option(const std::string&, float&, const std::string&);
template Option Command::option(const std::string&, double&, const std::string&);
template Option Command::option(const std::string&, std::optional<std::string>&,
                                const std::string&);
template Option Command::option(const std::string&, std::optional<int>&, const std::string&);
template Option Command::option(const std::string&, std::optional<long>&, const std::string&);
template Option Command::option(const std::string&, std::optional<unsigned>&, const std::string&);
template Option Command::option(const std::string&, std::optional<std::size_t>&,
                                const std::string&);
template Option Command::option(const std::string&, std::optional<double>&, const std::string&);
template Option Command::option(const std::string&, std::vector<std::filesystem::path>&,
                                const std::string&);
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&);
template Option Command::option(const std::string&, std::vector<int>&, const std::string&);
template Option Command::option(const std::string&, std::vector<unsigned>&, const std::string&);
template Option Command::option(const std::string&, std::vector<float>&, const std::string&);
template Option Command::option(const std::string&, std::vector<double>&, const std::string&);

Option Command::flag(const std::string& names, bool& value, const std::string& help) {
    return Option(*app_->add_flag(names, value, help));
}

void Command::examples(const std::vector<std::string>& lines) {
    add_examples(*app_, lines);
}

void Command::footer(const std::string& text) {
    app_->footer(text);
}

void Command::exit_status(int status, const std::string& meaning) {
    add_exit_status(*app_, status, meaning);
}

void Command::on_run(std::function<void()> run) {
    app_->callback(std::move(run));
}

std::string Command::typed_with(const std::vector<std::string>& more) const {
    const CLI::App* program = app_;
    while (program->get_parent())
        program = program->get_parent();
    std::vector<std::string> words = *typed_;
    words.insert(std::ranges::find(words, "--"), more.begin(), more.end()); // options end there
    return shell_line(program->get_name(), words);
}

CommandReference Command::reference() const {
    return reference_of(*app_);
}

std::string Command::help(const std::vector<std::string>& words) const {
    const CLI::App* command = app_;
    for (const std::string& word : words) {
        const auto all = command->get_subcommands([](const CLI::App*) { return true; });
        const auto below = std::ranges::find(all, word, &CLI::App::get_name);
        if (below == all.end()) {
            std::vector<std::string> names;
            for (const CLI::App* each : all)
                names.push_back(each->get_name());
            throw UsageError(unknown_word(word, names));
        }
        command = *below;
    }
    return command->get_formatter()->make_help(command, "", CLI::AppFormatMode::Normal);
}

namespace {

int fail(const char* program, const std::string& what, int status) {
    print_result(one_line(what));
    print_safely(stderr, "{}: {}\n", program, what);
    return status;
}

/// The command that opens a file, by its suffix.
std::string_view command_for(const std::filesystem::path& file) {
    const std::string suffix = file.extension().string();
    if (suffix == ".isochron")
        return "explore";
    if (suffix == ".jsonl")
        return "replay";
    return suffix == ".png" || suffix == ".exr" || suffix == ".jpg" ? "reproduce" : "build";
}

/// What the user may have meant by a word, one of those that were typed, that is no command.
std::string mistaken(const std::string& word, const std::vector<std::string>& typed,
                     const std::vector<std::string>& names) {
    std::error_code error;
    if (std::filesystem::exists(word, error))
        return fmt::format("{}: a file, not a command; did you mean `{}`?", word,
                           shell_line(fmt::format("isochron {}", command_for(word)), typed));
    return unknown_word(word, names);
}

/// The message about arguments that the command does not know.
std::string unexpected(const CLI::App& command) {
    const std::vector<std::string> unknown = command.remaining();
    const auto option = std::ranges::find_if(
        unknown, [](const std::string& each) { return each.starts_with('-'); });
    if (option == unknown.end())
        return fmt::format("{}: one argument too many", fmt::join(unknown, " "));
    std::vector<std::string> names;
    for (const CLI::Option* known : command.get_options())
        if (!known->get_group().empty() && !known->get_lnames().empty())
            names.push_back("--" + known->get_lnames().front());
    const std::string word = option->substr(0, option->find('='));
    return fmt::format("{}: unknown option{}", word, meant(nearest_word(word, names)));
}

/// The parser's complaint in one line.
/// @param name gets the command whose help explains more
std::string complaint(const CLI::App& program, const std::vector<std::string>& typed,
                      const CLI::ParseError& error, std::string& name) {
    const CLI::App* command = &program;
    name = program.get_name();
    while (!command->get_subcommands().empty()) {
        command = command->get_subcommands().front();
        name += " " + command->get_name();
    }
    std::string what = error.what();
    // For an unknown command CLI11 says only that a command is missing.
    const std::vector<std::string> unknown = command->remaining();
    const auto known = command->get_subcommands([](const CLI::App*) { return true; });
    const bool is_option = !unknown.empty() && unknown.front().starts_with('-');
    if (!known.empty() && !is_option) {
        std::vector<std::string> names;
        for (const CLI::App* candidate : known)
            names.push_back(candidate->get_name());
        what = unknown.empty() ? fmt::format("{}, expected {}", what, fmt::join(names, ", "))
                               : mistaken(unknown.front(), typed, names);
    } else if (!unknown.empty()) {
        what = unexpected(*command);
    } else if (const std::string_view wrong = "Could not convert: "; what.starts_with(wrong)) {
        // CLI11 says `--name = text`; only numbers are converted, so only they can fail this way.
        what.erase(0, wrong.size());
        if (const std::size_t equals = what.find(" = "); equals != std::string::npos)
            what.replace(equals, 3, ": expected a number, got ");
    }
    return what;
}

/// Flags that had another spelling up to version 0.1, and their spelling now.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kOldFlags{{
    {"--colour", "--color"},
    {"--colour-component", "--color-component"},
    {"--colour-unit", "--color-unit"},
}};

/// Whether a word in the place of a command is data to explore, maybe with a path within.
bool is_data(const CLI::App& program, const std::string& word) {
    if (index::is_link(word))
        return true;
    const std::string file = word.substr(0, word.find(":/"));
    const std::string_view command = command_for(file);
    std::error_code error;
    const auto known = program.get_subcommands([](const CLI::App*) { return true; });
    const auto is_command = [&](std::string_view name) {
        return std::ranges::any_of(known,
                                   [&](const CLI::App* each) { return each->get_name() == name; });
    };
    return !is_command(word) && is_command("explore") &&
           (command == "explore" || command == "build") && std::filesystem::exists(file, error);
}

/// The arguments in today's spelling. `isochron DATA` is `isochron explore DATA`.
std::vector<std::string> arguments_from(const CLI::App& program, int argc,
                                        const char* const* argv) {
    std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    for (std::string& word : arguments) // what opens a link is told to nobody
        word = index::address_of(word);
    for (std::string& argument : arguments) {
        const std::size_t end = std::min(argument.find('='), argument.size());
        for (const auto& [old, now] : kOldFlags)
            if (std::string_view(argument).substr(0, end) == old) {
                argument.replace(0, end, now);
                break;
            }
    }
    if (arguments.empty())
        arguments.emplace_back("--help");
    const auto first = std::ranges::find_if(
        arguments, [](const std::string& word) { return !word.starts_with('-'); });
    if (first != arguments.end() && is_data(program, *first))
        arguments.insert(arguments.begin(), "explore");
    return arguments;
}

/// Tells at its end what a command took.
class TellsCost {
  public:
    TellsCost() = default;
    TellsCost(const TellsCost&) = delete;
    TellsCost& operator=(const TellsCost&) = delete;
    ~TellsCost() {
        if (!tells(Telling::verbose))
            return;
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began_;
        rusage used{};
        getrusage(RUSAGE_SELF, &used);
        constexpr double kPage = 1024;
        print_detail("took {:.2f} s, at most {} of memory", took.count(),
                     human_bytes(kPage * static_cast<double>(used.ru_maxrss)));
    }

  private:
    std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

/// Errors of the commands pass through; errors of the parser become an exit status.
int parse_and_run(const ProgramText& text,
                  std::initializer_list<void (*)(Command& program)> commands, int argc,
                  const char* const* argv) {
    CLI::App program{text.description, text.name};
    program.set_version_flag("--version",
                             fmt::format("{} {}{}", text.name, kVersion,
                                         text.version_details ? text.version_details() : ""),
                             "Print the version and what this build has");
    program.require_subcommand(1);
    program.set_help_all_flag("--help-all", "Print the help of every command");
    write_help(program);
    add_telling_options(program);
    if (text.examples.size() > 0)
        add_examples(program, {text.examples.begin(), text.examples.end()});
    std::vector<std::string> typed;
    Command root(program, typed);
    for (const auto add : commands)
        add(root);
    if (text.first_commands > 0)
        begin_with_first(program, text.first_commands);
    typed = arguments_from(program, argc, argv);
    set_telling(typed);
    print_detail("version {}", kVersion);
    const TellsCost cost;
    try {
        program.parse(std::vector<std::string>(typed.rbegin(), typed.rend())); // as CLI11 wants
    } catch (const CLI::Success& request) {
        return program.exit(request);
    } catch (const CLI::ParseError& error) {
        std::string command;
        const std::string what = complaint(program, typed, error, command);
        return fail(text.name, fmt::format("{} (see {} --help)", what, command), 2);
    }
    return 0;
}

} // namespace

void read_words(const std::vector<std::string>& words,
                const std::function<void(Command& command)>& add) {
    CLI::App app;
    Command command(app, words);
    add(command);
    try {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    } catch (const CLI::ParseError& error) {
        std::string name;
        throw UsageError(complaint(app, words, error, name));
    }
}

int run_program(const ProgramText& text, std::initializer_list<void (*)(Command& program)> commands,
                int argc, const char* const* argv) {
    // A file that may not grow further (ulimit -f) is an error of the call that writes, with a line.
    std::signal(SIGXFSZ, SIG_IGN);
    keep_freed_memory();
    prepare_for_shortage(text.name);
    EndInTime::allow(text.name);
    int status = 0;
    try {
        status = parse_and_run(text, commands, argc, argv);
    } catch (const Canceled& canceled) {
        while (!EndInTime::is_first_to_tell())
            ::pause(); // it is told and ended now
        return fail(text.name, canceled.what(), canceled.status);
    } catch (const ReportedElsewhere&) {
        return 0;
    } catch (const UsageError& error) {
        return fail(text.name, error.what(), 2);
    } catch (const std::bad_alloc&) {
        return fail(text.name, index::shortage_of_memory(), 1);
    } catch (const std::filesystem::filesystem_error& error) {
        const std::string path = error.path1().empty() ? "." : error.path1().string();
        return fail(text.name, fmt::format("{}: {}", path, error.code().message()), 1);
    } catch (const std::system_error& error) { // std::thread has no other cause
        if (error.code() != std::errc::resource_unavailable_try_again)
            return fail(text.name, error.what(), 1);
        return fail(text.name,
                    fmt::format("a thread cannot be started: {}", index::shortage_of_memory()), 1);
    } catch (const nlohmann::json::exception& error) {
        return fail(text.name, index::json_mistake(error), 1);
    } catch (const std::exception& error) {
        return fail(text.name, error.what(), 1);
    }
    print_result();
    // Output that did not arrive, for example on a full disk behind a redirection, is an error.
    if (std::fflush(stdout) != 0)
        return fail(text.name, "the output cannot be written", 1);
    return status;
}

} // namespace isochron::app
