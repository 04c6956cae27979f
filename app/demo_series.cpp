// The series that the program can make by itself.
#include "app/demo_series.h"

#include "app/random_velocity.h"
#include "index/error.h"
#include "index/new_file.h"
#include "index/series_writer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace isochron::app {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Where a series goes, and the note beside it of how it was made.
struct Destination {
    fs::path dir;
    std::string name;
    json recipe;

    fs::path note() const { return dir / (name + ".json"); }

    /// The .pvd appears last, so with it everything is there.
    /// @throws Error when it is there with another recipe
    bool complete() const {
        const fs::path pvd = dir / (name + ".pvd");
        if (!fs::exists(pvd))
            return false;
        std::ifstream file(note());
        if (json::parse(file, nullptr, false) == recipe)
            return true;
        throw index::Error(fmt::format("{}: is another series than {}; remove it or choose another "
                                       "folder",
                                       pvd.string(), recipe.dump()));
    }

    void write_note() const {
        const std::string text = recipe.dump(2) + "\n";
        index::NewFile file(note());
        file.write_at(0, std::as_bytes(std::span(text)));
        file.commit();
    }
};

index::SeriesInfo info_of(const std::string& array, std::array<std::size_t, 3> vertices,
                          double spacing, index::ValueType type) {
    index::SeriesInfo info;
    info.array = array;
    for (std::size_t axis = 0; axis < 3; ++axis)
        info.grid.vertices[axis] = static_cast<std::uint32_t>(vertices[axis]);
    info.grid.spacing = glm::dvec3(spacing);
    info.type = type;
    return info;
}

void append(index::SeriesWriter& writer, const std::vector<float>& values, double time,
            index::ValueType type, float scale) {
    assert(type == index::ValueType::f32 || type == index::ValueType::u8);
    if (type == index::ValueType::f32) {
        writer.append(std::as_bytes(std::span(values)), time);
        return;
    }
    std::vector<std::uint8_t> rounded(values.size());
    std::transform(values.begin(), values.end(), rounded.begin(), [scale](float value) {
        return static_cast<std::uint8_t>(std::lround(scale * value));
    });
    writer.append(std::as_bytes(std::span(rounded)), time);
}

} // namespace

bool generate(const SphereSeries& series, const fs::path& dir, const index::Progress& progress) {
    const Destination destination{
        dir,
        "sphere",
        {{"series", "sphere"}, {"type", index::name_of(series.type)}, {"steps", series.steps}}};
    if (destination.complete())
        return false;
    constexpr std::array<std::size_t, 3> kVertices{61, 50, 60};
    const auto writer = index::write_pvd(dir, destination.name,
                                         info_of(destination.name, kVertices, 1.0, series.type));
    std::vector<float> values(kVertices[0] * kVertices[1] * kVertices[2]);
    for (std::size_t step = 0; step < series.steps; ++step) {
        const auto time = static_cast<double>(step);
        const glm::dvec3 centre =
            glm::dvec3(22, 19, 22) + 0.25 * time * glm::dvec3(0.8, 0.36, 0.48);
        auto value = values.begin();
        for (std::size_t z = 0; z < kVertices[2]; ++z)
            for (std::size_t y = 0; y < kVertices[1]; ++y)
                for (std::size_t x = 0; x < kVertices[0]; ++x) {
                    const glm::dvec3 d = glm::dvec3(x, y, z) - centre;
                    *value++ = static_cast<float>(255.0 * std::exp(-glm::dot(d, d) / 242.0));
                }
        append(*writer, values, time, series.type, 1.0F);
        progress("making sphere",
                 static_cast<double>(step + 1) / static_cast<double>(series.steps));
    }
    destination.write_note();
    writer->finish();
    return true;
}

bool generate(const VorticitySeries& series, const fs::path& dir, const index::Progress& progress) {
    // Chosen by measurement over several seeds, at the isovalue where 3,940 cells are active on
    // average: added and removed cells together are some 45 % of the active ones from one step to
    // the next. Finer grids step finer, so that surfaces move by as many cells.
    constexpr double kPeak = 1.0;        // most energy in vortices as large as the cube
    constexpr double kViscosity = 0.008; // the smallest eddies are just resolved at 64^3
    constexpr std::size_t kSubsteps = 3; // of the integrator from one step to the next
    const double dt = 0.0222 * 64.0 / static_cast<double>(series.size);
    // How soon vortices stretch each other into tubes differs from seed to seed, and shows in the
    // enstrophy: it starts below 3 and peaks near 15. The time is for cubes too coarse for that.
    constexpr double kFirstEnstrophy = 10.0;
    constexpr double kLatestStart = 4.0;

    const Destination destination{dir,
                                  "vorticity",
                                  {{"series", "vorticity"},
                                   {"seed", series.seed},
                                   {"type", index::name_of(series.type)},
                                   {"size", series.size},
                                   {"steps", series.steps},
                                   {"viscosity", kViscosity},
                                   {"spectrum_peak", kPeak},
                                   {"first_enstrophy", kFirstEnstrophy},
                                   {"time_step", static_cast<double>(kSubsteps) * dt}}};
    if (destination.complete())
        return false;
    const double spacing = 2.0 * std::numbers::pi / static_cast<double>(series.size);
    const auto writer = index::write_pvd(
        dir, destination.name,
        info_of(destination.name, {series.size, series.size, series.size}, spacing, series.type));

    NavierStokes flow(series.size, kViscosity, random_velocity(series.size, series.seed, kPeak));
    while (flow.enstrophy() < kFirstEnstrophy && flow.time() < kLatestStart) {
        flow.advance(dt);
        progress("developing turbulence",
                 std::max(flow.time() / kLatestStart, flow.enstrophy() / kFirstEnstrophy));
    }

    // The highest value of all steps is known at the end only: rounded steps wait for it.
    struct Step {
        std::vector<float> values;
        double time;
    };
    std::vector<Step> waiting;
    float highest = 0.0F;
    for (std::size_t step = 0; step < series.steps; ++step) {
        progress("computing steps", static_cast<double>(step) / static_cast<double>(series.steps));
        for (std::size_t i = 0; i < kSubsteps && step > 0; ++i)
            flow.advance(dt);
        const Field magnitude = flow.vorticity_magnitude();
        std::vector<float> values(magnitude.begin(), magnitude.end());
        if (series.type == index::ValueType::f32) {
            append(*writer, values, flow.time(), series.type, 1.0F);
            continue;
        }
        highest = std::max(highest, *std::max_element(values.begin(), values.end()));
        waiting.push_back({std::move(values), flow.time()});
    }
    for (const Step& step : waiting)
        append(*writer, step.values, step.time, series.type, 255.0F / highest);
    destination.write_note();
    writer->finish();
    return true;
}

} // namespace isochron::app
