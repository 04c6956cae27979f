// The help texts as roff.
#include "app/command_line/manual_pages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace isochron::app {
namespace {

/// Escapes text for roff: dashes that can be copied, no line that roff takes for a command.
std::string roff(std::string_view text) {
    std::string result;
    for (const char letter : text) {
        const bool starts_line = result.empty() || result.back() == '\n';
        if (starts_line && (letter == '.' || letter == '\''))
            result += "\\&";
        if (letter == '-')
            result += "\\-";
        else if (letter == '\\')
            result += "\\(rs";
        else
            result += letter;
    }
    return result;
}

/// A long list of words, whose lines may end after a comma.
std::string breakable(std::string_view list) {
    std::string result;
    for (const char letter : roff(list)) {
        result += letter;
        if (letter == ',')
            result += "\\:";
    }
    return result;
}

std::string page_name(const CommandPath& path) {
    return fmt::format("{}", fmt::join(path.words, "-"));
}

std::string option_line(const OptionReference& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.names)
        names.push_back(fmt::format("\\fB{}\\fR", roff(name)));
    std::string line = fmt::format("{}", fmt::join(names, ", "));
    if (!option.value.empty())
        line += fmt::format("{}\\fI{}\\fR", line.empty() ? "" : " ", breakable(option.value));
    return line;
}

std::string synopsis(const CommandPath& path) {
    std::string line =
        fmt::format("\\fB{}\\fR", roff(fmt::format("{}", fmt::join(path.words, " "))));
    if (!path.command->commands.empty())
        return line + " \\fICOMMAND\\fR [\\fIOPTION\\fR...]";
    line += " [\\fIOPTION\\fR...]";
    for (const OptionReference& option : path.command->options)
        if (option.names.empty())
            line += fmt::format(fmt::runtime(option.required ? " \\fI{}\\fR" : " [\\fI{}\\fR]"),
                                roff(option.value));
    return line;
}

/// The headings in the order in which they first appear, arguments before options.
std::vector<std::string> headings(const CommandReference& command) {
    std::vector<std::string> found;
    for (const OptionReference& option : command.options)
        if (option.names.empty())
            found = {option.heading};
    for (const OptionReference& option : command.options)
        if (std::ranges::find(found, option.heading) == found.end())
            found.push_back(option.heading);
    return found;
}

std::string page(const CommandPath& path, const std::string& version,
                 const std::vector<CommandPath>& all) {
    const CommandReference& command = *path.command;
    std::string title = page_name(path);
    std::ranges::transform(title, title.begin(),
                           [](unsigned char letter) { return char(std::toupper(letter)); });
    std::string text = fmt::format(".\\\" Made by `isochron manual` from the program's own help.\n"
                                   ".TH {} 1 \"\" \"{}\" \"Isochron manual\"\n.ad l\n"
                                   ".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}\n.SH DESCRIPTION\n{}\n",
                                   roff(title), version, roff(page_name(path)),
                                   roff(command.help.substr(0, command.help.find('.'))),
                                   synopsis(path), roff(command.help));
    if (!command.examples.empty())
        text += fmt::format(".SH EXAMPLES\n.nf\n{}\n.fi\n",
                            roff(fmt::format("{}", fmt::join(command.examples, "\n"))));
    if (!command.commands.empty()) {
        text += ".SH COMMANDS\n";
        for (const CommandReference& below : command.commands)
            text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(below.name), roff(below.help));
    }
    for (const std::string& heading : headings(command)) {
        std::string capitals = heading;
        std::ranges::transform(capitals, capitals.begin(),
                               [](unsigned char letter) { return char(std::toupper(letter)); });
        text += fmt::format(".SH \"{}\"\n", roff(capitals));
        for (const OptionReference& option : command.options)
            if (option.heading == heading)
                text += fmt::format(".TP\n{}\n{}\n", option_line(option), roff(option.help));
    }
    if (!command.footer.empty())
        text += fmt::format(".SH NOTES\n.nf\n{}\n.fi\n", roff(command.footer));
    std::vector<std::string> others;
    for (const CommandPath& other : all)
        if (other.command != path.command)
            others.push_back(fmt::format("\\fB{}\\fR(1)", roff(page_name(other))));
    return text + fmt::format(".SH \"SEE ALSO\"\n{}\n", fmt::join(others, ",\n"));
}

} // namespace

std::vector<ManualPage> manual_pages(const CommandReference& program, const std::string& version) {
    const std::vector<CommandPath> all = all_commands(program);
    std::vector<ManualPage> pages;
    for (const CommandPath& path : all)
        pages.push_back({page_name(path) + ".1", page(path, version, all)});
    return pages;
}

} // namespace isochron::app
