// `isochron-generate`: makes the demo series, as `isochron generate` starts it.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/generate/demo_series.h"
#include "app/generate/generate_options.h"
#include "app/telling.h"

#include <nlohmann/json.hpp>

#include <string_view>

namespace {

using namespace isochron::app;

template <class Series>
void make(const Series& series, const std::filesystem::path& dir, bool force) {
    const std::string pvd = (dir / (std::string(Series::kName) + ".pvd")).string();
    bool made = false;
    {
        const CancelOnSignal signals;
        ProgressBar bar;
        made = generate(
            series, dir,
            [&](std::string_view phase, double fraction) {
                signals.check();
                bar.show(phase, fraction);
            },
            force);
    }
    tell_result({{"file", pvd}, {"steps", series.steps}, {"written", made}});
    print_report("{}: {} steps{}\n", pvd, series.steps, made ? "" : ", made before");
}

void add_generate(Command& program) {
    add_generate_options(program, [](const Command&, const DemoRequest& request) {
        std::visit([&](const auto& series) { make(series, request.dir, request.force); },
                   request.series);
    });
}

} // namespace

/// The messages name `isochron`, the program that the user has called.
int main(int argc, char** argv) {
    return run_program(
        {.name = "isochron", .description = "Make demo series.", .version_details = nullptr},
        {add_generate}, argc, argv);
}
