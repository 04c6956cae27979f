// The help texts as roff.
#include "app/command_line/manual_pages.h"

#include "app/command_line/help_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string_view>
#include <utility>

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

std::string capitals(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char letter) { return char(std::toupper(letter)); });
    return text;
}

/// A section with an entry for each of `rows`. @param name,text of a row
template <class Rows, class Name, class Text>
std::string section(const std::string& heading, const Rows& rows, const Name& name,
                    const Text& text) {
    if (rows.empty())
        return {};
    std::string lines = fmt::format(".SH \"{}\"\n", roff(capitals(heading)));
    for (const auto& row : rows)
        lines += fmt::format(".TP\n{}\n{}\n", name(row), roff(text(row)));
    return lines;
}

/// Lines that stay lines.
std::string lines_section(const std::string& heading, const std::string& lines) {
    return lines.empty() ? lines : fmt::format(".SH {}\n.nf\n{}\n.fi\n", heading, roff(lines));
}

std::string page(const CommandPath& path, const std::string& version,
                 const std::vector<CommandPath>& all) {
    constexpr std::size_t kColumns = 72; // as man(1) leaves them of 80
    const CommandReference& command = *path.command;
    std::string text = fmt::format(".\\\" Made by `isochron manual` from the program's own help.\n"
                                   ".TH {} 1 \"\" \"{}\" \"Isochron manual\"\n.ad l\n"
                                   ".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}\n.SH DESCRIPTION\n{}\n",
                                   roff(capitals(page_name(path))), version, roff(page_name(path)),
                                   roff(command.help.substr(0, command.help.find('.'))),
                                   roff(usage_of(path)), roff(command.help));
    const auto bold = [](const std::string& name) { return fmt::format("\\fB{}\\fR", roff(name)); };
    text += section(
        "Commands", command.commands, [&](const auto& below) { return bold(below.name); },
        [](const auto& below) { return below.help; });
    for (const std::string& heading : headings_of(command)) {
        std::vector<OptionReference> options;
        std::ranges::copy_if(command.options, std::back_inserter(options),
                             [&](const auto& option) { return option.heading == heading; });
        text +=
            section(heading, options, option_line, [](const auto& option) { return option.help; });
    }
    text += lines_section("NOTES", footer_lines(command.footer, kColumns));
    text += section(
        "Exit status", command.exits,
        [&](const auto& exit) { return bold(std::to_string(exit.first)); },
        [](const auto& exit) { return exit.second; });
    for (const auto& [heading, rows] :
         {std::pair("Files", files_of(path)), std::pair("Environment", environment_of(path))})
        text += section(
            heading, rows, [&](const auto& row) { return bold(row.name); },
            [](const auto& row) { return row.help; });
    text += lines_section("EXAMPLES", fmt::format("{}", fmt::join(command.examples, "\n")));
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
