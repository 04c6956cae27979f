// Wraps the help of a command.
#include "app/command_line/help_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

#include <sys/ioctl.h>
#include <unistd.h>

namespace isochron::app {
namespace {

constexpr std::size_t kIndent = 26; ///< columns before the text of an option

/// The words of `text` in lines of at most `width` columns, the first behind `begin`, the others behind
/// `indent` spaces. @param end of a line that goes on
std::string wrapped(const std::string& begin, const std::string& text, std::size_t indent,
                    std::size_t width, std::string_view end = "") {
    std::string lines, line = begin;
    bool first = true; // word of a line
    std::istringstream words(text);
    for (std::string word; words >> word; first = false) {
        if (!first && line.size() + 1 + word.size() + end.size() > width) {
            lines += line + std::string(end) + '\n';
            line.assign(indent, ' ');
            first = true;
        }
        line += (first ? "" : " ") + word;
    }
    return lines + line + '\n';
}

/// A row of two columns; a long first one has a line of its own.
std::string row(const std::string& name, const std::string& text, std::size_t width) {
    std::string begin = "  " + name;
    if (begin.size() + 2 <= kIndent)
        begin.resize(kIndent, ' ');
    else
        begin += '\n' + std::string(kIndent, ' ');
    const std::size_t line = begin.rfind('\n') + 1; // 0: none
    return begin.substr(0, line) + wrapped(begin.substr(line), text, kIndent, width);
}

std::string name_of(const OptionReference& option) {
    return fmt::format("{}{}{}", fmt::join(option.names, ", "),
                       option.names.empty() || option.value.empty() ? "" : " ", option.value);
}

} // namespace

std::size_t help_width() {
    constexpr std::size_t kUsual = 80, kLeast = 40;
    winsize size{};
    if (isatty(STDOUT_FILENO) != 1 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 ||
        size.ws_col == 0)
        return kUsual;
    return std::max<std::size_t>(size.ws_col, kLeast);
}

std::string footer_lines(const std::string& footer, std::size_t width) {
    std::string result, paragraph;
    const auto end_paragraph = [&] {
        if (!paragraph.empty())
            result += wrapped("", paragraph, 0, width);
        paragraph.clear();
    };
    std::istringstream lines(footer);
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty() && line.front() != ' ') {
            paragraph += line + '\n';
            continue;
        }
        end_paragraph();
        if (line.empty()) {
            result += '\n';
            continue;
        }
        // The second column of a table is kept in its place.
        const std::size_t text_at = line.find_first_not_of(' ');
        const std::size_t gap = line.find("  ", text_at);
        const std::size_t second = gap == line.npos ? gap : line.find_first_not_of(' ', gap);
        const std::size_t at = second == line.npos || second > width / 2 ? text_at : second;
        result +=
            wrapped(line.substr(0, at), line.substr(at), at == text_at ? text_at + 2 : at, width);
    }
    end_paragraph();
    return result;
}

std::string usage_of(const CommandPath& command) {
    const bool needs_command = !command.command->commands.empty();
    std::string usage = fmt::format("{}{} [OPTION...]", fmt::join(command.words, " "),
                                    needs_command ? " COMMAND" : "");
    for (const OptionReference& option : command.command->options)
        if (option.names.empty())
            usage += fmt::format(fmt::runtime(option.required ? " {}" : " [{}]"), option.value);
        else if (option.required)
            usage += fmt::format(" {} {}", option.names.front(), option.value);
    return usage;
}

std::string help_text(const CommandPath& command, std::size_t width) {
    const CommandReference& about = *command.command;
    std::string text = wrapped("", about.help, 0, width);
    text += '\n' + wrapped("Usage: ", usage_of(command), 9, width);
    std::vector<std::string> headings;
    for (const CommandReference& below : about.commands)
        if (std::ranges::find(headings, below.heading) == headings.end())
            headings.push_back(below.heading);
    for (const std::string& heading : headings) {
        text += fmt::format("\n{}:\n", heading);
        for (const CommandReference& below : about.commands)
            if (below.heading == heading)
                text += row(below.name, below.help, width);
    }
    for (const std::string& heading : headings_of(about)) {
        text += fmt::format("\n{}:\n", heading);
        for (const OptionReference& option : about.options)
            if (option.heading == heading)
                text += row(name_of(option), option.help, width);
    }
    if (!about.footer.empty())
        text += '\n' + footer_lines(about.footer, width);
    if (about.commands.empty()) {
        std::vector<std::string> exits;
        for (const auto& [status, meaning] : about.exits)
            exits.push_back(fmt::format("{} {}", status, meaning));
        text +=
            '\n' + wrapped("Exit status: ", fmt::format("{}.", fmt::join(exits, ", ")), 0, width);
    }
    if (!about.examples.empty()) {
        text += "\nExamples:\n";
        for (const std::string& line : about.examples)
            text += wrapped("  ", line, 4, width, " \\");
    }
    return text;
}

} // namespace isochron::app
