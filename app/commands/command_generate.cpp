// `isochron generate`: makes the demo series.
#include "app/command_line/cancel.h"
#include "app/command_line/subcommands.h"
#include "app/generate/demo_series.h"
#include "app/indexing/progress_bar.h"
#include "app/output/guarded_outputs.h"

#include <fmt/format.h>

#include <memory>
#include <vector>

namespace isochron::app {

namespace {

/// A series, with the options that all series have.
template <class Series>
struct Request {
    Series series;
    std::string type{"f32"};
    std::filesystem::path dir;
    bool force = false;
};

/// Adds `generate NAME` with the options that every series has.
/// @return its subcommand and request, to which the caller adds the series' own options
template <class Series>
std::pair<Command, std::shared_ptr<Request<Series>>> add_series(Command& generate_command,
                                                                const std::string& description) {
    const std::string name = Series::kName;
    Command command = generate_command.subcommand(name, description);
    auto request = std::make_shared<Request<Series>>();
    command.option("-o,--out", request->dir, "Output folder; created if missing").required();
    command.option("--type", request->type, "Stored type: f32 (default), or u8 (rounded)")
        .one_of({"f32", "u8"});
    command.option("--steps", request->series.steps, "Number of time steps")
        .between(1, 100000)
        .shows_default();
    command.flag("--force", request->force,
                 "Replace another series, or any files, of the names that are written");
    command.on_run([request, name] {
        request->series.type = *index::value_type_from_name(request->type);
        const auto pvd = (request->dir / (name + ".pvd")).string();
        std::vector<Output> outputs;
        for (const auto& file : files_in_the_way(request->series, request->dir))
            outputs.push_back({file, OutputKind::series});
        guard_outputs(outputs, {}, request->force);
        bool made = false;
        {
            const CancelOnSignal signals;
            ProgressBar bar;
            made = generate(
                request->series, request->dir,
                [&](std::string_view phase, double fraction) {
                    signals.check();
                    bar.show(phase, fraction);
                },
                request->force);
        }
        fmt::print("{}: {} steps{}\n", pvd, request->series.steps, made ? "" : ", made before");
    });
    return {command, request};
}

template <class Series>
void add_cube_options(Command& command, const std::shared_ptr<Request<Series>>& request,
                      std::size_t largest) {
    command.option("--seed", request->series.seed, "Start of the random numbers").shows_default();
    command.option("--size", request->series.size, "Vertices along each axis")
        .between(std::size_t{16}, largest)
        .shows_default();
}

} // namespace

void add_generate(Command& program) {
    Command command = program.subcommand("generate", "Make a demo series as .pvd and .vti files.");
    command.require_subcommand();
    add_series<SphereSeries>(command, "A moving sphere, 61 x 50 x 60 vertices");
    auto [vorticity, flow] =
        add_series<VorticitySeries>(command, "Vorticity magnitude of decaying turbulence");
    add_cube_options(vorticity, flow, 256);
    auto [fourier, modes] = add_series<FourierSeries>(
        command,
        "Vorticity magnitude of random Fourier modes: turbulence of any size, made quickly");
    add_cube_options(fourier, modes, 1024);
    fourier.option("--modes", modes->series.modes, "How many modes")
        .between(std::size_t{1}, std::size_t{4096})
        .shows_default();
    fourier
        .option("--longest", modes->series.longest,
                "Longest wave vector of a mode, in waves along an axis: more is rougher, at most "
                "half the size")
        .between(2, 512)
        .shows_default();
}

} // namespace isochron::app
