// Help with examples, and commands and options as data.
#include "app/command_line/command_help.h"

#include <CLI/CLI.hpp>

#include <map>
#include <memory>
#include <sstream>
#include <utility>

namespace isochron::app {
namespace {

/// Writes the examples of a command between what it is for and how it is called.
class HelpWithExamples : public CLI::Formatter {
  public:
    std::string make_description(const CLI::App* command) const override {
        std::string text = CLI::Formatter::make_description(command);
        const auto found = examples.find(command);
        if (found == examples.end())
            return text;
        text += "\nExamples:\n";
        for (const std::string& line : found->second)
            text += "  " + line + "\n";
        return text + "\n";
    }

    std::map<const CLI::App*, std::vector<std::string>> examples;
};

/// Null unless `show_examples` was called for its program.
std::shared_ptr<HelpWithExamples> help_of(const CLI::App& command) {
    return std::dynamic_pointer_cast<HelpWithExamples>(command.get_formatter());
}

/// The words of "{a,b,c}" in CLI11's description of a value; empty if it lists none.
std::vector<std::string> listed_words(const std::string& shown) {
    std::vector<std::string> words;
    const std::size_t begin = shown.find('{');
    const std::size_t end = shown.find('}', begin);
    if (begin == std::string::npos || end == std::string::npos)
        return words;
    std::istringstream list(shown.substr(begin + 1, end - begin - 1));
    for (std::string word; std::getline(list, word, ',');)
        words.push_back(word);
    return words;
}

OptionReference reference_of(const CLI::Option& option) {
    OptionReference reference;
    for (const std::string& name : option.get_snames())
        reference.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        reference.names.push_back("--" + name);
    if (reference.names.empty())
        reference.value = option.get_name();
    else if (option.get_expected_max() > 0)
        reference.value = option.get_type_name();
    reference.words = listed_words(option.get_type_name());
    reference.help = option.get_description();
    reference.heading = reference.names.empty() ? "Arguments" : option.get_group();
    reference.required = option.get_required();
    return reference;
}

} // namespace

void show_examples(CLI::App& program) {
    auto help = std::make_shared<HelpWithExamples>();
    help->label("SUBCOMMAND", "COMMAND");
    program.formatter(help);
}

void add_examples(CLI::App& command, std::vector<std::string> lines) {
    help_of(command)->examples[&command] = std::move(lines);
}

void begin_with_first(CLI::App& program, std::size_t count) {
    std::size_t number = 0;
    for (CLI::App* command : program.get_subcommands([](CLI::App*) { return true; }))
        command->group(number++ < count ? "Commands to begin with" : "More commands");
}

CommandReference reference_of(const CLI::App& command) {
    CommandReference reference{
        command.get_name(), command.get_description(), {}, command.get_footer(), {}, {}};
    if (const auto help = help_of(command))
        if (const auto found = help->examples.find(&command); found != help->examples.end())
            reference.examples = found->second;
    for (const CLI::Option* option : command.get_options())
        if (!option->get_group().empty())
            reference.options.push_back(reference_of(*option));
    for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
        reference.commands.push_back(reference_of(*below));
    return reference;
}

} // namespace isochron::app
