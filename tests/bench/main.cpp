// `isochron-bench`: measures parts of the program against their rivals.
#include "tests/bench/benchmarks.h"

int main(int argc, char** argv) {
    using namespace isochron;
    return app::run_program({.name = "isochron-bench",
                             .description = "Measure Isochron's parts against their rivals.",
                             .version_details = nullptr},
                            {bench::add_index, bench::add_render, bench::add_artifacts,
                             bench::add_between, bench::add_building, bench::add_change,
                             bench::add_motion, bench::add_scale},
                            argc, argv);
}
