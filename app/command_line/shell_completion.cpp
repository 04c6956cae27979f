// Completion scripts for bash, zsh and fish.
#include "app/command_line/shell_completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace isochron::app {
namespace {

/// `text` between single quotes, as all three shells read it; fish also reads backslashes there.
std::string in_quotes(std::string_view text, bool backslashes = false) {
    std::string result = "'";
    for (const char letter : text) {
        if (letter == '\'')
            result += backslashes ? "\\'" : "'\\''";
        else if (letter == '\\' && backslashes)
            result += "\\\\";
        else
            result += letter;
    }
    return result + "'";
}

/// The first sentence of a help text, without its full stop.
std::string_view first_sentence(std::string_view help) {
    return help.substr(0, help.find(". ")).substr(0, help.find_last_not_of('.') + 1);
}

std::vector<std::string> words_after(const CommandReference& command) {
    std::vector<std::string> words;
    for (const CommandReference& below : command.commands)
        words.push_back(below.name);
    for (const OptionReference& option : command.options)
        words.insert(words.end(), option.names.begin(), option.names.end());
    return words;
}

std::string called(const CommandPath& path, std::string_view between) {
    return fmt::format("{}", fmt::join(path.words, between));
}

std::string bash(const CommandReference& program) {
    std::string offers;
    std::string values;
    std::string below;
    for (const CommandPath& path : all_commands(program)) {
        const std::string name = called(path, " ");
        if (path.words.size() > 1)
            below += fmt::format("{}{}", below.empty() ? "" : "|", in_quotes(name));
        offers +=
            fmt::format("    {}) offers={} ;;\n", in_quotes(name),
                        in_quotes(fmt::format("{}", fmt::join(words_after(*path.command), " "))));
        for (const OptionReference& option : path.command->options)
            for (const std::string& spelling : option.names)
                if (!option.value.empty())
                    values += fmt::format(
                        "    {}) takes=1 words={} ;;\n", in_quotes(name + " " + spelling),
                        in_quotes(fmt::format("{}", fmt::join(option.words, " "))));
    }
    return fmt::format(R"(# Completion of isochron for bash, made by `isochron completion bash`.
_isochron() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} last=${{COMP_WORDS[COMP_CWORD-1]}} called=isochron offers= words= takes= i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$called ${{COMP_WORDS[i]}}" in
    {}) called="$called ${{COMP_WORDS[i]}}" ;;
    esac
  done
  case "$called $last" in
{}  esac
  if [[ -n $takes ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
    return
  fi
  case "$called" in
{}  esac
  COMPREPLY=($(compgen -W "$offers" -- "$word"))
}}
complete -o default -F _isochron isochron
)",
                       below, values, offers);
}

/// One specification for zsh's _arguments, in which brackets and colons are escaped.
std::string zsh_argument(const OptionReference& option, const std::string& spelling) {
    std::string help;
    for (const char letter : first_sentence(option.help)) {
        if (letter == '[' || letter == ']' || letter == ':' || letter == '\\')
            help += '\\';
        help += letter;
    }
    std::string value;
    if (!option.value.empty())
        value = option.words.empty() ? ":value:_files"
                                     : fmt::format(":value:({})", fmt::join(option.words, " "));
    return in_quotes(fmt::format("{}[{}]{}", spelling, help, value));
}

std::string zsh(const CommandReference& program) {
    std::string text = "#compdef isochron\n# Made by `isochron completion zsh`.\n";
    for (const CommandPath& path : all_commands(program)) {
        const CommandReference& command = *path.command;
        text += fmt::format("_{}() {{\n", called(path, "_"));
        std::string arguments;
        for (const OptionReference& option : command.options)
            for (const std::string& spelling : option.names)
                arguments += fmt::format(" \\\n    {}", zsh_argument(option, spelling));
        if (command.commands.empty()) {
            text += fmt::format("  _arguments{} \\\n    '*:file:_files'\n}}\n", arguments);
            continue;
        }
        std::string names;
        std::string cases;
        for (const CommandReference& below : command.commands) {
            names += fmt::format(
                " {}", in_quotes(fmt::format("{}:{}", below.name, first_sentence(below.help))));
            cases += fmt::format("    {0}) _{1}_{0} ;;\n", below.name, called(path, "_"));
        }
        text += fmt::format("  local state line\n"
                            "  _arguments -C{} \\\n    '1: :->command' '*:: :->rest'\n"
                            "  case $state in\n  command) local -a commands=({} )\n"
                            "    _describe command commands ;;\n"
                            "  rest) case $line[1] in\n{}    esac ;;\n  esac\n}}\n",
                            arguments, names, cases);
    }
    return text + "_isochron \"$@\"\n";
}

std::string fish(const CommandReference& program) {
    std::string text = "# Completion of isochron for fish, made by `isochron completion fish`.\n";
    for (const CommandPath& path : all_commands(program)) {
        std::string here;
        for (std::size_t i = 1; i < path.words.size(); ++i)
            here += fmt::format("{}__fish_seen_subcommand_from {}", i > 1 ? "; and " : "",
                                path.words[i]);
        const CommandReference& command = *path.command;
        if (!command.commands.empty()) {
            std::vector<std::string> names;
            for (const CommandReference& below : command.commands)
                names.push_back(below.name);
            here += fmt::format("{}not __fish_seen_subcommand_from {}",
                                here.empty() ? "" : "; and ", fmt::join(names, " "));
        }
        const std::string start = fmt::format("complete -c isochron -n {}", in_quotes(here, true));
        for (const CommandReference& below : command.commands)
            text += fmt::format("{} -f -a {} -d {}\n", start, below.name,
                                in_quotes(first_sentence(below.help), true));
        for (const OptionReference& option : command.options) {
            if (option.names.empty())
                continue;
            text += start;
            for (const std::string& name : option.names)
                text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.words.empty())
                text += fmt::format(
                    " -x -a {}", in_quotes(fmt::format("{}", fmt::join(option.words, " ")), true));
            else if (!option.value.empty())
                text += " -r";
            text += fmt::format(" -d {}\n", in_quotes(first_sentence(option.help), true));
        }
    }
    return text;
}

} // namespace

const std::vector<std::string>& completed_shells() {
    static const std::vector<std::string> shells{"bash", "zsh", "fish"};
    return shells;
}

std::string shell_completion(const CommandReference& program, const std::string& shell) {
    return shell == "bash" ? bash(program) : shell == "zsh" ? zsh(program) : fish(program);
}

} // namespace isochron::app
