// `isochron generate`: makes the demo series.
#include "app/cancel.h"
#include "app/commands.h"
#include "app/demo_series.h"
#include "app/progress_bar.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

namespace isochron::app {

namespace {

/// What every series can be asked for.
template <class Series>
struct Request {
    Series series;
    std::filesystem::path dir;
};

/// Adds `generate NAME` with the options that every series has.
/// @return its subcommand and request, for the options of its own
template <class Series>
std::pair<CLI::App*, std::shared_ptr<Request<Series>>> add_series(CLI::App& generate_command,
                                                                  const std::string& description) {
    const std::string name = Series::kName;
    CLI::App* command = generate_command.add_subcommand(name, description);
    auto request = std::make_shared<Request<Series>>();
    command->add_option("--out", request->dir, "Folder to write into; made where it is missing")
        ->required();
    command
        ->add_option_function<std::string>(
            "--type",
            [request](const std::string& type) {
                request->series.type = *index::value_type_from_name(type);
            },
            "Stored type: f32 (default), or u8 (rounded)")
        ->check(CLI::IsMember({"f32", "u8"}));
    command->add_option("--steps", request->series.steps, "Number of time steps")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command->callback([request, name] {
        const auto pvd = (request->dir / (name + ".pvd")).string();
        bool made = false;
        {
            const CancelOnSignal signals;
            ProgressBar bar;
            made = generate(request->series, request->dir,
                            [&](std::string_view phase, double fraction) {
                                signals.check();
                                bar.show(phase, fraction);
                            });
        }
        fmt::print("{}: {} steps{}\n", pvd, request->series.steps, made ? "" : ", made before");
    });
    return {command, request};
}

template <class Series>
void add_cube_options(CLI::App& command, const std::shared_ptr<Request<Series>>& request,
                      std::size_t largest) {
    command.add_option("--seed", request->series.seed, "Start of the random numbers")
        ->capture_default_str();
    command.add_option("--size", request->series.size, "Vertices along each axis")
        ->check(CLI::Range(std::size_t{16}, largest))
        ->capture_default_str();
}

} // namespace

void add_generate(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("generate", "Make a demo series as .pvd and .vti files.");
    command->require_subcommand(1);
    add_series<SphereSeries>(*command, "A moving sphere, 61 x 50 x 60 vertices");
    const auto [vorticity, flow] =
        add_series<VorticitySeries>(*command, "Vorticity magnitude of decaying turbulence");
    add_cube_options(*vorticity, flow, 256);
    const auto [fourier, modes] = add_series<FourierSeries>(
        *command, "Vorticity magnitude of 96 random Fourier modes: turbulence of any size, soon "
                  "made");
    add_cube_options(*fourier, modes, 1024);
}

} // namespace isochron::app
