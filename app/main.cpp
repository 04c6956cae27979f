// The program and its subcommands.
#include "app/commands/subcommands.h"

int main(int argc, char** argv) {
    using namespace isochron::app;
    return run_program("isochron", "Explore time-varying volume data immersively.",
                       {add_build, add_query, add_change, add_info, add_verify, add_explore,
                        add_replay, add_reproduce, add_movie, add_generate, add_config},
                       argc, argv);
}
