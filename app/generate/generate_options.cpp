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
    command.examples({"isochron generate " + name + " -o " + name, short_one});
    auto request = std::make_shared<Request<Series>>();
    command
        .option("-o,--output,--out FOLDER", request->dir,
                "Folder for the files; it is made where it is missing")
        .required();
    command.option("--type TYPE", request->type, "Type of the values, where u8 rounds them")
        .one_of({"f32", "u8"})
        .shows_default();
    command.option("--step-count,--steps COUNT", request->series.steps, "Number of steps")
        .between(1, 100000)
        .shows_default();
    command.flag("--force", request->force,
                 "Replace files that exist, of another series or of anything else");
    command.on_run([command, request, run] {
        request->series.type = *index::value_type_from_name(request->type);
        run(command, {request->series, request->dir, request->force});
    });
    return {command, request};
}

template <class Series>
void add_cube_options(Command& command, const std::shared_ptr<Request<Series>>& request,
                      std::size_t largest) {
    command.option("--seed NUMBER", request->series.seed, "Seed of the random numbers")
        .shows_default();
    command.option("--size COUNT", request->series.size, "Number of vertices along each axis")
        .between(std::size_t{16}, largest)
        .shows_default();
}

} // namespace

void add_generate_options(Command& program, const Run& run) {
    Command command = program.subcommand("generate", "Make a demo series as .pvd and .vti files.");
    command.examples({"isochron generate vorticity -o flow",
                      "isochron generate sphere -o short --step-count 5"});
    command.require_subcommand();
    add_series<SphereSeries>(command, "A moving sphere on a grid of 61 x 50 x 60 vertices",
                             "isochron generate sphere -o short --step-count 5", run);
    auto [vorticity, flow] = add_series<VorticitySeries>(
        command, "Vorticity magnitude of decaying turbulence",
        "isochron generate vorticity -o small --size 16 --step-count 3", run);
    add_cube_options(vorticity, flow, 256);
    auto [fourier, modes] = add_series<FourierSeries>(
        command,
        "Vorticity magnitude of random Fourier modes, which makes turbulence of any size quickly",
        "isochron generate fourier -o small --size 32 --step-count 2 --type u8", run);
    add_cube_options(fourier, modes, 1024);
    fourier.option("--modes COUNT", modes->series.modes, "Number of modes")
        .between(std::size_t{1}, std::size_t{4096})
        .shows_default();
    fourier
        .option("--longest COUNT", modes->series.longest,
                "Longest wave vector of a mode, as the number of waves along an axis: at most half "
                "of --size. A larger number makes a rougher field")
        .between(2, 512)
        .shows_default();
}

} // namespace isochron::app
