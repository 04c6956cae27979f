// Makes the data of the motion benchmark.
#include "tests/bench/motion/data.h"

#include "app/generate/demo_fields.h"
#include "app/generate/fourier_modes.h"
#include "index/indexing/index_build.h"
#include "tests/bench/motion/fields.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <functional>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;

/// A series whose steps are made when they are read.
class MadeMoving : public index::VolumeSeries {
  public:
    using Make = std::function<void(std::size_t step, std::span<float> values)>;

    MadeMoving(const MovedData& data, const std::string& array, Make make, float scale)
        : make_(std::move(make)), scale_(scale) {
        info_.array = array;
        info_.grid.vertices.fill(static_cast<std::uint32_t>(data.size));
        info_.type = data.type;
        for (std::size_t step = 0; step < data.steps; ++step) {
            info_.times.push_back(static_cast<double>(step));
            info_.sources.emplace_back(data.kept);
        }
    }
    const index::SeriesInfo& info() const override { return info_; }
    void read(std::size_t step, std::span<std::byte> out) override {
        if (info_.type == index::ValueType::f32) {
            make_(step, {reinterpret_cast<float*>(out.data()), out.size() / sizeof(float)});
            return;
        }
        std::vector<float> values(out.size());
        make_(step, values);
        std::ranges::transform(values, out.begin(), [this](float value) {
            return static_cast<std::byte>(std::lround(std::clamp(scale_ * value, 0.0F, 255.0F)));
        });
    }

  private:
    index::SeriesInfo info_;
    Make make_;
    float scale_; ///< scale of bytes
};

/// The first few of a series with more steps.
MadeMoving::Make vorticity_of(const MovedData& data, const index::Progress& progress) {
    auto steps = std::make_shared<std::vector<std::vector<std::byte>>>();
    make_steps(
        app::VorticitySeries{.size = data.size, .steps = data.steps},
        [&](std::span<const std::byte> values, double) {
            steps->emplace_back(values.begin(), values.end());
        },
        progress);
    return [steps](std::size_t step, std::span<float> values) {
        std::memcpy(values.data(), (*steps)[step].data(), values.size_bytes());
    };
}

constexpr std::size_t kModes = 64;

/// Turbulence of which step follows step as surfaces that move by a voxel or two.
MadeMoving::Make turbulence_of(const MovedData& data, std::uint64_t seed) {
    const auto modes = std::make_shared<app::FourierModes>(seed, kModes, data.longest);
    const double pace = 40.0 / static_cast<double>(data.size);
    return [modes, size = data.size, pace](std::size_t step, std::span<float> values) {
        modes->vorticity_magnitude(size, pace * static_cast<double>(step), values);
    };
}

/// Bytes of which 255 stands for 3.5 times the root of the mean square.
float turbulence_scale(int longest) {
    double square = 0;
    const app::FourierModes turbulence(kSeedOfTurbulence, kModes, longest);
    for (const app::FourierModes::Mode& mode : turbulence.modes())
        square += 0.5 * (mode.curl[0] * mode.curl[0] + mode.curl[1] * mode.curl[1] +
                         mode.curl[2] * mode.curl[2]);
    return static_cast<float>(255 / (3.5 * std::sqrt(square)));
}

MadeMoving made(const MovedData& data, const index::Progress& progress) {
    switch (data.field) {
    case MovedField::vorticity: return {data, "vorticity", vorticity_of(data, progress), 1};
    case MovedField::turbulence:
        return {data, "turbulence", turbulence_of(data, kSeedOfTurbulence),
                turbulence_scale(data.longest)};
    case MovedField::tubes: return {data, "tubes", tubes_of(data.size), 1};
    case MovedField::specks: return {data, "specks", specks_of(data.size), 1};
    }
    throw index::Error("no such field");
}

} // namespace

const std::vector<MovedData>& moved_data() {
    using enum MovedField;
    using index::ValueType;
    static const std::vector<MovedData> all{
        {.name = "demo", .kept = "vorticity64", .field = vorticity, .size = 64, .steps = 8},
        {.name = "192",
         .kept = "turbulence192",
         .field = turbulence,
         .size = 192,
         .longest = 14,
         .isovalues = {1.636}},
        {.name = "256",
         .kept = "turbulence256",
         .field = turbulence,
         .size = 256,
         .isovalues = {2.452}},
        {.name = "512",
         .kept = "turbulence512",
         .field = turbulence,
         .size = 512,
         .steps = 3,
         .type = ValueType::u8,
         .longest = 16,
         .isovalues = {131.5}},
        {.name = "512-dense",
         .kept = "turbulence512",
         .field = turbulence,
         .size = 512,
         .steps = 3,
         .type = ValueType::u8,
         .longest = 16,
         .isovalues = {120.5}},
        {.name = "1024",
         .kept = "turbulence1024",
         .field = turbulence,
         .size = 1024,
         .steps = 2,
         .type = ValueType::u8,
         .longest = 10,
         .isovalues = {130.5},
         .large = true},
        {.name = "tubes", .kept = "tubes256", .field = tubes, .size = 256, .isovalues = {0.5}},
        {.name = "specks", .kept = "specks256", .field = specks, .size = 256, .isovalues = {0.5}},
        {.name = "two",
         .kept = "turbulence128",
         .field = turbulence,
         .size = 128,
         .isovalues = {2.6, 1.9},
         .opacity = 0.5f},
        {.name = "colored",
         .kept = "colored192",
         .field = turbulence,
         .size = 192,
         .longest = 14,
         .isovalues = {1.636},
         .colors = true},
    };
    return all;
}

std::vector<std::string> moved_names() {
    std::vector<std::string> names;
    for (const MovedData& data : moved_data())
        names.push_back(data.name);
    return names;
}

const MovedData& moved(const std::string& name) {
    const auto found = std::ranges::find(moved_data(), name, &MovedData::name);
    assert(found != moved_data().end());
    return *found;
}

std::shared_ptr<const index::IndexFile> open_moved(const MovedData& data, const fs::path& folder,
                                                   const index::Progress& progress) {
    const fs::path path = folder / (data.kept + ".isochron");
    if (!fs::exists(path)) {
        MadeMoving series = made(data, progress);
        MadeMoving color(data, "other turbulence", turbulence_of(data, kSeedOfColors),
                         turbulence_scale(data.longest));
        index::BuildOptions options;
        options.color = data.colors ? &color : nullptr;
        index::build_index(series, path, options, progress);
    }
    return index::IndexFile::open(path);
}

app::ExplorerState shown_of(const MovedData& data, app::ExplorerState state) {
    static constexpr glm::vec3 kSecond{0.45f, 0.65f, 0.95f};
    for (std::size_t i = 0; i < data.isovalues.size(); ++i) {
        if (i >= state.isosurfaces.size())
            state.isosurfaces.push_back({0, kSecond, 1});
        state.isosurfaces[i].isovalue = data.isovalues[i];
    }
    for (interaction::Isosurface& surface : state.isosurfaces)
        surface.opacity = data.opacity;
    if (data.colors)
        state.coloring.by = interaction::ColorBy::value;
    return state;
}

} // namespace isochron::bench
