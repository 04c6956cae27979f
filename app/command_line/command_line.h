// Subcommands and their options; only command_line.cpp and command_help.cpp include the parser's library.
//
//     void add_verify(Command& program) {
//         auto path = std::make_shared<std::filesystem::path>();
//         Command command = program.subcommand("verify", "Compare every checksum of an index.");
//         command.option("file NAME.isochron", *path, "Index").required();
//         command.on_run([path] { run_verify(*path); });
//     }
#pragma once

#include "app/command_line/command_reference.h"

#include <fmt/core.h>

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace isochron::app {

/// Thrown by a command for wrong usage that the parser cannot see: exit status 2.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// The message as a format with its values.
    template <class... Values>
    explicit UsageError(fmt::format_string<Values...> text, Values&&... values)
        : std::runtime_error(fmt::format(text, std::forward<Values>(values)...)) {}
};

/// Thrown by the other processes of a job when rank 0 reports an error: they print nothing and
/// leave the exit status to rank 0.
class ReportedElsewhere {};

/// One option of a command, or one positional argument. Setters return the option.
class Option {
  public:
    explicit Option(CLI::Option& option) : option_(&option) {}

    Option& required();
    /// The heading under which help lists the option.
    Option& group(const std::string& heading);
    /// Refused if `other` is not given.
    Option& needs(const Option& other);
    /// Help says nothing of it: another spelling of earlier versions.
    Option& hidden();
    /// Takes one value each time that it is given, and may be given several times.
    Option& repeatable();
    /// Takes several values with commas between them.
    Option& comma_separated();
    /// Help shows the value that the variable has now.
    Option& shows_default();
    /// Refuses values outside [low, high]. T: int, unsigned or std::size_t.
    template <class T>
    Option& between(T low, T high);
    /// @param former names of earlier versions, which are accepted and not told
    Option& one_of(const std::vector<std::string>& names,
                   const std::vector<std::string>& former = {});
    /// Accepts finite numbers above zero.
    Option& positive();
    Option& existing_file();
    Option& existing_folder();
    /// `complaint` returns what is wrong with a value, empty if nothing is; `form` is how help
    /// describes the accepted values.
    Option& accepted_by(std::function<std::string(const std::string&)> complaint,
                        const std::string& form);

    /// Whether the user gave it; known once the command runs.
    bool given() const;

  private:
    CLI::Option* option_;
};

/// The program or one of its subcommands. A handle: copies name the same command.
class Command {
  public:
    /// @param typed the words behind the program's name; live as long as the command
    Command(CLI::App& app, const std::vector<std::string>& typed) : app_(&app), typed_(&typed) {}

    Command subcommand(const std::string& name, const std::string& description);
    /// The user must name one of the subcommands.
    void require_subcommand();
    /// `form` is the option as help shows it, `-s,--long FILE`, or a word for a positional argument
    /// with its value, `file INDEX`. `--size PIXELS PIXELS` takes exactly two values, and
    /// `--control [SOCKET]` may be given without one: then the variable is an empty text. Further long
    /// names are spellings of earlier versions, which are accepted and not told: `-o,--output,--out`.
    /// `value` must live until the command has run. Its type says what is parsed: a path, a string, a
    /// finite number, a std::optional of one, or a std::vector of them.
    template <class T>
    Option option(const std::string& form, T& value, const std::string& help);
    Option flag(const std::string& names, bool& value, const std::string& help);
    /// Examples at the end of the command's help: commands as a user types them.
    void examples(const std::vector<std::string>& lines);
    /// Text below the options in the command's help. Lines that begin with spaces stay lines; others
    /// are parts of a paragraph.
    void footer(const std::string& text);
    /// What an exit status of the command means, where it is more than `done` and `bad input`.
    void exit_status(int status, const std::string& meaning);
    void on_run(std::function<void()> run);
    /// The words behind the program's name, as the user typed them.
    const std::vector<std::string>& typed() const { return *typed_; }
    /// What the user typed with `more` options, in words of a shell: the command that a message
    /// proposes.
    std::string typed_with(const std::vector<std::string>& more) const;
    /// Its options, and its subcommands added so far.
    CommandReference reference() const;
    /// The help of the program, or of the command that `words` lead to, as wide as the terminal.
    /// @throws UsageError: there is no such command
    std::string help(const std::vector<std::string>& words) const;

  private:
    CLI::App* app_;
    const std::vector<std::string>* typed_;
};

/// Takes the options of a command that is not typed: the words are made by a program.
/// @param add adds the options @throws UsageError naming the option that is wrong
void read_words(const std::vector<std::string>& words,
                const std::function<void(Command& command)>& add);

/// What a program says of itself.
struct ProgramText {
    const char* name;
    const char* description;
    std::string (
        *version_details)(); ///< what --version prints behind name and version; may be null
    std::initializer_list<const char*> examples{}; ///< commands with which help begins
    /// So many commands are listed before the others, under a heading of their own.
    std::size_t first_commands = 0;
};

/// Parses the arguments, runs the one subcommand that they name, and turns errors into one line.
/// Returns the exit status: 0 done, 1 bad input, 2 bad usage, 130 interrupted.
int run_program(const ProgramText& program,
                std::initializer_list<void (*)(Command& program)> commands, int argc,
                const char* const* argv);

} // namespace isochron::app
