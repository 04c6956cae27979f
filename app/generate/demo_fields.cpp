// Generates the demo data.
#include "app/generate/demo_fields.h"

#include "app/generate/fourier_modes.h"
#include "app/generate/random_velocity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

namespace isochron::app {

namespace {

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

index::SeriesInfo info_of_cube(const std::string& array, std::size_t size, index::ValueType type) {
    return info_of(array, {size, size, size}, 2.0 * std::numbers::pi / static_cast<double>(size),
                   type);
}

double part(std::size_t done, std::size_t of) {
    return static_cast<double>(done) / static_cast<double>(of);
}

/// Passes a step to the sink; for u8 its values are multiplied by `scale` and rounded.
void send(const StepSink& sink, const std::vector<float>& values, double time,
          index::ValueType type, float scale) {
    assert(type == index::ValueType::f32 || type == index::ValueType::u8);
    if (type == index::ValueType::f32) {
        sink(std::as_bytes(std::span(values)), time);
        return;
    }
    std::vector<std::uint8_t> rounded(values.size());
    std::transform(values.begin(), values.end(), rounded.begin(), [scale](float value) {
        return static_cast<std::uint8_t>(std::lround(scale * value));
    });
    sink(std::as_bytes(std::span(rounded)), time);
}

constexpr std::array<std::size_t, 3> kSphereVertices{61, 50, 60};

} // namespace

index::SeriesInfo describe(const SphereSeries& series) {
    return info_of(series.kName, kSphereVertices, 1.0, series.type);
}

index::SeriesInfo describe(const VorticitySeries& series) {
    return info_of_cube(series.kName, series.size, series.type);
}

index::SeriesInfo describe(const FourierSeries& series) {
    return info_of_cube(series.kName, series.size, series.type);
}

void make_steps(const SphereSeries& series, const StepSink& sink, const index::Progress& progress) {
    std::vector<float> values(kSphereVertices[0] * kSphereVertices[1] * kSphereVertices[2]);
    for (std::size_t step = 0; step < series.steps; ++step) {
        const auto time = static_cast<double>(step);
        const glm::dvec3 center =
            glm::dvec3(22, 19, 22) + 0.25 * time * glm::dvec3(0.8, 0.36, 0.48);
        auto value = values.begin();
        for (std::size_t z = 0; z < kSphereVertices[2]; ++z)
            for (std::size_t y = 0; y < kSphereVertices[1]; ++y)
                for (std::size_t x = 0; x < kSphereVertices[0]; ++x) {
                    const glm::dvec3 d = glm::dvec3(x, y, z) - center;
                    *value++ = static_cast<float>(255.0 * std::exp(-glm::dot(d, d) / 242.0));
                }
        send(sink, values, time, series.type, 1.0F);
        progress("making sphere", part(step + 1, series.steps));
    }
}

void make_steps(const VorticitySeries& series, const StepSink& sink,
                const index::Progress& progress) {
    NavierStokes flow(series.size, series.kViscosity,
                      random_velocity(series.size, series.seed, series.kPeak));
    while (flow.enstrophy() < series.kFirstEnstrophy && flow.time() < series.kLatestStart) {
        flow.advance(series.substep());
        progress("developing turbulence", std::max(flow.time() / series.kLatestStart,
                                                   flow.enstrophy() / series.kFirstEnstrophy));
    }

    // Rounding needs the highest value of all steps, so u8 steps are kept until the end.
    struct Step {
        std::vector<float> values;
        double time;
    };
    std::vector<Step> waiting;
    float highest = 0.0F;
    for (std::size_t step = 0; step < series.steps; ++step) {
        progress("computing steps", part(step, series.steps));
        for (std::size_t i = 0; i < series.kSubsteps && step > 0; ++i)
            flow.advance(series.substep());
        const Field magnitude = flow.vorticity_magnitude();
        std::vector<float> values(magnitude.begin(), magnitude.end());
        if (series.type == index::ValueType::f32) {
            send(sink, values, flow.time(), series.type, 1.0F);
            continue;
        }
        highest = std::max(highest, *std::max_element(values.begin(), values.end()));
        waiting.push_back({std::move(values), flow.time()});
    }
    for (const Step& step : waiting)
        send(sink, step.values, step.time, series.type, 255.0F / highest);
}

void make_steps(const FourierSeries& series, const StepSink& sink,
                const index::Progress& progress) {
    const FourierModes flow(series.seed, series.modes, series.longest);
    std::vector<float> values(series.size * series.size * series.size);
    const auto each_step = [&](std::string_view phase, const auto& use) {
        for (std::size_t step = 0; step < series.steps; ++step) {
            progress(phase, part(step, series.steps));
            flow.vorticity_magnitude(series.size, static_cast<double>(step), values);
            use(static_cast<double>(step));
        }
    };
    // Computing every step twice is cheaper than keeping all steps until the highest value is
    // known.
    float scale = 1.0F;
    if (series.type != index::ValueType::f32) {
        float highest = 0.0F;
        each_step("finding the highest value", [&](double) {
            highest = std::max(highest, *std::max_element(values.begin(), values.end()));
        });
        scale = 255.0F / highest;
    }
    each_step("computing steps",
              [&](double time) { send(sink, values, time, series.type, scale); });
}

} // namespace isochron::app
