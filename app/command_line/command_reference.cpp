// The tree of commands, flattened into a list.
#include "app/command_line/command_reference.h"

namespace isochron::app {
namespace {

void add_commands(const CommandReference& command, std::vector<std::string> words,
                  std::vector<CommandPath>& into) {
    words.push_back(command.name);
    into.push_back({words, &command});
    for (const CommandReference& below : command.commands)
        add_commands(below, words, into);
}

} // namespace

std::vector<CommandPath> all_commands(const CommandReference& program) {
    std::vector<CommandPath> all;
    add_commands(program, {}, all);
    return all;
}

} // namespace isochron::app
