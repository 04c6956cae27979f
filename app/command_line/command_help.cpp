// Commands and options of the parser's library as data, and their help.
#include "app/command_line/command_help.h"

#include "app/command_line/help_text.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <ranges>
#include <sstream>
#include <utility>

namespace isochron::app {
namespace {

/// Writes help by `help_text`, and keeps what the parser's library has no place for.
class WrittenHelp : public CLI::FormatterBase {
  public:
    std::string make_help(const CLI::App* command, std::string /*name*/,
                          CLI::AppFormatMode mode) const override {
        std::vector<std::string> words;
        for (const CLI::App* at = command; at; at = at->get_parent())
            words.insert(words.begin(), at->get_name());
        const CommandReference reference = reference_of(*command);
        const CommandPath path{words, &reference};
        const std::size_t width = help_width();
        if (mode != CLI::AppFormatMode::All)
            return help_text(path, width);
        std::string text;
        for (CommandPath each : all_commands(reference)) {
            each.words.insert(each.words.begin(), words.begin(), words.end() - 1);
            text += help_text(each, width) + '\n';
        }
        return text;
    }

    std::map<const CLI::App*, std::vector<std::string>> examples;
    std::map<const CLI::App*, std::map<int, std::string>> exits;
};

/// Null unless `write_help` was called for its program.
std::shared_ptr<WrittenHelp> help_of(const CLI::App& command) {
    return std::dynamic_pointer_cast<WrittenHelp>(command.get_formatter());
}

/// What a word of a value says in help: the parser's type, and the forms of what is accepted.
struct ShownValue {
    std::string type, form;
    std::vector<std::string> words; ///< where the form lists them: `{a,b,c}`
};

ShownValue shown_value(const CLI::Option& option) {
    std::istringstream parts(option.get_type_name());
    ShownValue shown;
    std::getline(parts, shown.type, kFormBegins.front());
    if (shown.type.ends_with(':') && !parts.eof())
        shown.type.pop_back();
    for (std::string form; std::getline(parts, form, kFormBegins.front());) {
        if (form.ends_with(':'))
            form.pop_back();
        if (!form.starts_with('{')) {
            shown.form = form;
            continue;
        }
        std::istringstream list(form.substr(1, form.size() - 2));
        for (std::string word; std::getline(list, word, ',');)
            shown.words.push_back(word);
    }
    return shown;
}

/// Words as help lists them: those that are others with an ending are told once.
std::string listed(const std::vector<std::string>& words) {
    const std::string ending = "_inverted";
    std::vector<std::string> plain;
    for (const std::string& word : words)
        if (!word.ends_with(ending))
            plain.push_back(word);
    std::string text = fmt::format("{}", fmt::join(plain, ", "));
    if (plain.size() < words.size())
        text += fmt::format(", or one of these words with {} behind it", ending);
    return text;
}

/// Whether a help text says of each word what it does.
bool explains(const std::string& help, const std::vector<std::string>& words) {
    return std::ranges::all_of(
        words, [&](const std::string& word) { return help.find(word) != std::string::npos; });
}

OptionReference reference_of(const CLI::Option& option) {
    OptionReference reference;
    for (const std::string& name : option.get_snames())
        reference.names.push_back("-" + name);
    if (!option.get_lnames().empty())
        reference.names.push_back("--" + option.get_lnames().front());
    const ShownValue shown = shown_value(option);
    if (reference.names.empty() || option.get_expected_max() > 0)
        reference.value = shown.type;
    if (reference.names.empty() && option.get_items_expected_max() > 1)
        reference.value += "...";
    reference.words = shown.words;
    reference.help = option.get_description();
    reference.heading = reference.names.empty() ? "Arguments" : option.get_group();
    reference.required = option.get_required();

    if (!explains(reference.help, shown.words)) {
        const std::size_t end =
            std::min(reference.help.rfind(" (default: "), reference.help.size());
        const bool one_sentence = reference.help.find(". ") == std::string::npos;
        reference.help.insert(end, (one_sentence ? ": " : ". It is one of ") + listed(shown.words));
    }
    std::vector<std::string> more;
    if (!shown.form.empty())
        more.push_back(shown.form);
    if (reference.value.empty() ? false : !option.get_default_str().empty())
        more.push_back("default: " + option.get_default_str());
    for (const CLI::Option* needed : option.get_needs())
        more.push_back("with " + needed->get_name());
    if (reference.required && !reference.names.empty())
        more.emplace_back("required");
    if (more.empty())
        return reference;
    const std::string words = fmt::format("{})", fmt::join(more, "; "));
    if (reference.help.ends_with(')') &&
        reference.help.rfind(" (default: ") == reference.help.rfind(" ("))
        reference.help.back() = ';';
    reference.help += (reference.help.ends_with(';') ? " " : " (") + words;
    return reference;
}

} // namespace

void write_help(CLI::App& program) {
    program.formatter(std::make_shared<WrittenHelp>());
}

void add_examples(CLI::App& command, std::vector<std::string> lines) {
    if (const auto help = help_of(command))
        help->examples[&command] = std::move(lines);
}

void add_exit_status(CLI::App& command, int status, const std::string& meaning) {
    if (const auto help = help_of(command))
        help->exits[&command][status] = meaning;
}

void begin_with_first(CLI::App& program, std::size_t count) {
    std::size_t number = 0;
    for (CLI::App* command : program.get_subcommands([](CLI::App*) { return true; }))
        command->group(number++ < count ? "Commands to begin with" : "More commands");
}

CommandReference reference_of(const CLI::App& command) {
    CommandReference reference{
        command.get_name(),
        command.get_description(),
        command.get_group(),
        {},
        command.get_footer(),
        {{0, "done"}, {1, "bad input"}, {2, "bad usage"}, {130, "interrupted by Ctrl-C"}},
        {},
        {}};
    if (const auto help = help_of(command)) {
        if (const auto found = help->examples.find(&command); found != help->examples.end())
            reference.examples = found->second;
        if (const auto found = help->exits.find(&command); found != help->exits.end())
            for (const auto& [status, meaning] : found->second)
                reference.exits[status] = meaning;
    }
    for (const CLI::Option* option : command.get_options())
        if (!option->get_group().empty())
            reference.options.push_back(reference_of(*option));
    for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
        reference.commands.push_back(reference_of(*below));
    return reference;
}

} // namespace isochron::app
