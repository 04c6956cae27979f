// The subcommands: each function adds one to the command line, with the callback that runs it.
#pragma once

#include "app/command_line/command_line.h"

namespace isochron::app {

void add_generate(Command& program);
void add_build(Command& program);
void add_query(Command& program);
void add_change(Command& program);
void add_info(Command& program);
void add_verify(Command& program);
void add_explore(Command& program);
void add_export(Command& program);
void add_figure(Command& program);
void add_measure(Command& program);
void add_table(Command& program);
void add_movie(Command& program);
void add_replay(Command& program);
void add_serve(Command& program);
void add_reproduce(Command& program);
void add_tell(Command& program);
void add_config(Command& program);
void add_help(Command& program);
void add_manual(Command& program);
void add_completion(Command& program);

} // namespace isochron::app
