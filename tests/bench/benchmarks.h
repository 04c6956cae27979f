// The benchmarks as subcommands of `isochron-bench`.
#pragma once

#include "app/command_line/command_line.h"

namespace isochron::bench {

void add_index(app::Command& program);
void add_render(app::Command& program);
void add_between(app::Command& program);
void add_building(app::Command& program);
void add_change(app::Command& program);
void add_artifacts(app::Command& program);
void add_motion(app::Command& program);
void add_scale(app::Command& program);

} // namespace isochron::bench
