// `generate` and its options.
#include "app/generate/generate_options.h"

#include <memory>
#include <string>
#include <utility>

namespace isochron::app {
namespace {

using Run = std::function<void(const Command&, const DemoRequest&)>;

/// A series, with the options that all series have.
template <class Series>
struct Request {
    Series series;
    std::string type{"f32"};
    std::filesystem::path dir;
    bool force = false;
};

/// Adds `generate NAME` with the options that every series has.
/// @param short_one the second example of its help: a series that is made in a moment
/// @return its subcommand and request, to which the caller adds the series' own options
template <class Series>
std::pair<Command, std::shared_ptr<Request<Series>>>
add_series(Command& generate_command, const std::string& description, const std::string& short_one,
           const Run& run) {
    Command command = generate_command.subcommand(Series::kName, description);
    const std::string name = Series::kName;
    command.examples({"isochron generate " + name + " --out " + name, short_one});
    auto request = std::make_shared<Request<Series>>();
    command.option("-o,--out", request->dir, "Output folder; created if missing").required();
    command.option("--type", request->type, "Stored type: f32 (default), or u8 (rounded)")
        .one_of({"f32", "u8"});
    command.option("--steps", request->series.steps, "Number of time steps")
        .between(1, 100000)
        .shows_default();
    command.flag("--force", request->force,
                 "Replace another series, or any files, of the names that are written");
    command.on_run([command, request, run] {
        request->series.type = *index::value_type_from_name(request->type);
        run(command, {request->series, request->dir, request->force});
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

void add_generate_options(Command& program, const Run& run) {
    Command command = program.subcommand("generate", "Make a demo series as .pvd and .vti files.");
    command.examples({"isochron generate vorticity --out flow",
                      "isochron generate sphere --out short --steps 5"});
    command.require_subcommand();
    add_series<SphereSeries>(command, "A moving sphere, 61 x 50 x 60 vertices",
                             "isochron generate sphere --out short --steps 5", run);
    auto [vorticity, flow] = add_series<VorticitySeries>(
        command, "Vorticity magnitude of decaying turbulence",
        "isochron generate vorticity --out small --size 16 --steps 3", run);
    add_cube_options(vorticity, flow, 256);
    auto [fourier, modes] = add_series<FourierSeries>(
        command,
        "Vorticity magnitude of random Fourier modes: turbulence of any size, made quickly",
        "isochron generate fourier --out small --size 32 --steps 2 --type u8", run);
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
