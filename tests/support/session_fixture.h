// A small data set, a context and a session for tests of the whole program.
#pragma once

#include "app/session/session.h"
#include "index/indexing/index_build.h"
#include "index/volume/blend.h"
#include "tests/support/paths.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

namespace isochron::app {

/// A sphere that moves along x: f32, values 16 minus the distance from the center.
class MovingSphere final : public index::VolumeSeries {
  public:
    /// @param edge vertices along each axis
    explicit MovingSphere(std::size_t steps, std::uint32_t edge = 32) {
        info_.array = std::string("distance");
        info_.length_unit = std::string("mm");
        info_.time_unit = std::string("s");
        info_.grid.vertices = {edge, edge, edge};
        for (std::size_t t = 0; t < steps; ++t)
            info_.times.push_back(0.5 * static_cast<double>(t));
        info_.sources = {"made in memory"};
    }
    const index::SeriesInfo& info() const override { return info_; }
    index::SeriesInfo& info() { return info_; }
    void read(std::size_t step, std::span<std::byte> out) override {
        std::size_t at = 0;
        const int edge = static_cast<int>(info_.grid.vertices[0]);
        for (int z = 0; z < edge; ++z)
            for (int y = 0; y < edge; ++y)
                for (int x = 0; x < edge; ++x) {
                    const double t = static_cast<double>(step);
                    const double dx = x - (12.0 + t), dy = y - 15.5, dz = z - 15.5;
                    const auto value =
                        static_cast<float>(16.0 - std::sqrt(dx * dx + dy * dy + dz * dz));
                    std::memcpy(out.data() + at, &value, sizeof value);
                    at += sizeof value;
                }
    }

  private:
    index::SeriesInfo info_;
};

/// The six steps of a moving sphere, and what lies between two of them as a seventh step.
class StepsAndABlend final : public index::VolumeSeries {
  public:
    static constexpr std::size_t kSteps = 6;
    explicit StepsAndABlend(index::Instant at) : at_(at) {
        info_ = sphere_.info();
        info_.type = index::ValueType::f64;
        info_.times.push_back(99);
    }
    const index::SeriesInfo& info() const override { return info_; }
    void read(std::size_t step, std::span<std::byte> out) override {
        const std::vector<float> now = values(step < kSteps ? step : at_.step);
        std::vector<double> all(now.begin(), now.end());
        if (step == kSteps) {
            const std::vector<float> next = values(at_.step + 1);
            for (std::size_t i = 0; i < all.size(); ++i)
                all[i] = index::blended(now[i], next[i], at_.fraction);
        }
        std::memcpy(out.data(), all.data(), out.size());
    }

  private:
    std::vector<float> values(std::size_t step) {
        std::vector<float> all(info_.grid.vertex_count());
        sphere_.read(step, std::as_writable_bytes(std::span(all)));
        return all;
    }
    MovingSphere sphere_{kSteps};
    index::Instant at_;
    index::SeriesInfo info_;
};

using test_support::TestFolder;

inline std::shared_ptr<const index::IndexFile> build_sphere(const std::filesystem::path& folder,
                                                            std::size_t steps = 6) {
    MovingSphere series(steps);
    build_index(series, folder / "sphere.isochron", {});
    return index::IndexFile::open(folder / "sphere.isochron");
}

/// A configuration for small pictures without a window.
inline Config small_config(stereo::StereoMode mode = stereo::StereoMode::side_by_side) {
    Config config = read_config(test_support::source_root() + "/configs/headless.toml");
    config.installation.windows.front().size = {256, 128};
    config.installation.windows.front().stereo = mode;
    config.quality.longest_ms = 0; // budgets are as tests have them
    config.quality.least_resolution = 1;
    return config;
}

/// Input with only a head at rest, at a time.
inline interaction::InputState head_at_rest(double seconds) {
    interaction::InputState input;
    input.time = interaction::Seconds(seconds);
    interaction::DeviceState head;
    head.name = "head";
    head.pose = interaction::Pose{{0.0f, 1.5f, 0.0f}, {1, 0, 0, 0}};
    input.devices.push_back(head);
    return input;
}

/// What a session draws with, and how long it has waited for something to do before the test goes on.
struct SessionKind {
    SessionKind(stereo::ContextKind with, interaction::Seconds has_waited = {})
        : context(with), age(has_waited) {}
    operator stereo::ContextKind() const { return context; }
    std::string name() const {
        return std::string(stereo::name_of(context)) + (age > age.zero() ? "_after_an_hour" : "");
    }
    friend void PrintTo(const SessionKind& kind, std::ostream* out) { *out << kind.name(); }

    stereo::ContextKind context;
    interaction::Seconds age;
};

/// A small series and a context without a window; instantiate it for EGL and OSMesa, and at several
/// ages if the tests call `grow_old`.
class SessionTest : public testing::TestWithParam<SessionKind> {
  protected:
    SessionTest()
        : file_(build_sphere(folder_.path())),
          context_(stereo::make_context(GetParam().context, {.size = {256, 128}})) {}

    /// The session waits as long as its age says, as the live loop lets it. @return that time
    static interaction::Seconds grow_old(Session& session) {
        if (GetParam().age > interaction::Seconds(0))
            session.has_waited();
        return GetParam().age;
    }

    TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_;
    std::unique_ptr<stereo::GlContext> context_;
};

inline constexpr interaction::Seconds kAnHour{3600};

inline constexpr auto context_name = [](const auto& kind) {
    return SessionKind(kind.param).name();
};

} // namespace isochron::app
