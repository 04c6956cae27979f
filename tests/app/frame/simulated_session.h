// A session without data or GL: somebody looks, moves, drags and plays at random, drawing takes known
// times, and a clock of the test goes on by frames. Only the quality of the frames is real.
#pragma once

#include "app/quality/frame_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace isochron::app {

/// A driver that can do nothing, and has no clock.
inline render::Gl gl_without_clock() {
    static int nothing = 0;
    render::Gl gl([](const char*) -> void* { return &nothing; });
    gl.GetQueryiv = [](GLenum, GLenum, GLint* bits) { *bits = 0; };
    gl.CreateQueries = [](GLenum, GLsizei, GLuint* name) { *name = 1; };
    gl.DeleteQueries = [](GLsizei, const GLuint*) {};
    return gl;
}

class SimulatedSession {
  public:
    static constexpr double kRate = 60; ///< frames a second

    struct Frame {
        FramePlan plan;
        FrameReport report;
        bool changed = false; ///< what the eyes see, apart from the footprint
        Milliseconds part_budget{0};
        std::optional<std::size_t> mesh; ///< level of the mesh that moves in the place of quads
    };

    explicit SimulatedSession(std::uint32_t seed)
        : random_(seed), quality_(gl_, config_of(random_), kRate) {
        available_.remove(render::Footprint::mesh);
        slower_ = between(0.05, 20);
        dear_ = between(1.2, 9);
        latency_ = any(4);
        by_pace_ = any(10) == 0;
        cells_ = between(1e3, 2e5);
    }

    Frame frame() {
        if (left_-- == 0)
            begin_phase();
        Frame now;
        now.changed = number_ == 0 || moves();
        now.report.time = waited_ + interaction::Seconds(number_++ / kRate);
        if (now.changed)
            last_change_ = now.report.time;
        const bool settles = now.report.time - last_change_ > interaction::Seconds(0.15);
        now.report.pace = phase_ == Phase::sway || (settles && phase_ != Phase::held_button)
                              ? interaction::Pace::settled
                              : interaction::Pace::moving;
        now.report.cells = static_cast<std::uint64_t>(cells_);
        if (counted_)
            now.report.volume_cells = static_cast<std::uint64_t>(2 * cells_);
        now.report.asked = {index::Instant(step_), {isovalue_}};
        if (phase_ != Phase::drag || any(3) == 0)
            shown_ = now.report.asked;
        now.report.shown = shown_;
        take_times();
        quality_.charge({1, 2e5}, state_.isosurfaces);
        render::FootprintSet possible = available_;
        if (has_meshes_)
            possible.add(render::Footprint::mesh);
        now.plan = quality_.choose(state_, now.changed,
                                   by_pace_ ? Choosing::by_pace : Choosing::with_parts, available_,
                                   possible, now.report);
        now.mesh = choose_mesh(now.report);
        now.part_budget = quality_.part_budget();
        draw(now);
        return now;
    }

    /// Nothing moves for a while, and no frame is drawn for as long as `wait`; then the head sways.
    void rest_and_sway(interaction::Seconds wait) {
        constexpr unsigned kFrames = 30;
        phase_ = Phase::rest;
        left_ = 2 * kFrames;
        for (unsigned i = 0; i < kFrames; ++i)
            frame();
        waited_ += wait;
        phase_ = Phase::sway;
    }

  private:
    enum class Phase : std::uint8_t { rest, sway, walk, drag, play, held_button };

    unsigned any(unsigned count) { return random_() % count; }
    double between(double low, double high) {
        return low + (high - low) * (random_() / 4294967296.0);
    }
    static Config config_of(std::mt19937& random) {
        const auto one_of = [&](auto values) { return values[random() % values.size()]; };
        Config config;
        config.quality.frame_budget_ms = one_of(std::array{0.0, 1e-6, 4.0, 8.0, 16.0, 1e4});
        config.quality.still_budget_ms = one_of(std::array{0.0, 50.0, 500.0, 500.0});
        config.quality.longest_ms = one_of(std::array{0.0, 20.0, 100.0});
        config.quality.least_resolution = one_of(std::array{1.0, 0.35});
        if (random() % 6 == 0)
            config.quality.settled = static_cast<render::Footprint>(random() % render::kFootprints);
        return config;
    }

    /// What goes on for the next frames, and what has become different with it.
    void begin_phase() {
        phase_ = static_cast<Phase>(any(6));
        left_ = 5 + any(60);
        state_.playback.playing = phase_ == Phase::play;
        switch (any(8)) {
        case 0: slower_ = between(0.05, 20); break;
        case 1: cells_ = between(1e3, 2e5); break;
        case 2: has_meshes_ = !has_meshes_; break;
        case 3: available_ = toggled(available_, render::Footprint::mesh); break;
        case 4: available_ = toggled(available_, render::Footprint::surface); break;
        case 5: counted_ = !counted_; break;
        case 6: state_.quality = static_cast<interaction::QualityMode>(any(2) ? 0 : any(4)); break;
        default:
            if (any(3) == 0)
                quality_.set_headset_period(any(2) ? std::optional(Milliseconds(1e3 / 90))
                                                   : std::nullopt);
        }
    }
    static render::FootprintSet toggled(render::FootprintSet set, render::Footprint footprint) {
        set.has(footprint) ? set.remove(footprint) : set.add(footprint);
        return set;
    }
    /// Whether this frame sees something else than the last one.
    bool moves() {
        switch (phase_) {
        case Phase::rest:
        case Phase::held_button: return false;
        case Phase::sway:
        case Phase::walk: return true;
        case Phase::drag: isovalue_ += 0.01; return true;
        case Phase::play: break;
        }
        if (left_ % 8 != 0)
            return false;
        ++step_;
        return true;
    }

    Milliseconds time_of(render::Footprint footprint, const DrawLoad& load,
                         std::size_t resolution) {
        const std::array dear{1.0, 2.5, 1.3, dear_};
        return Milliseconds(
            slower_ * (1 - 0.15 * static_cast<double>(resolution)) * between(0.95, 1.05) *
            (0.5 + 2.5e-5 * dear[static_cast<std::size_t>(footprint)] * load.cells));
    }
    std::optional<std::size_t> choose_mesh(const FrameReport& report) {
        MeshesAtHand meshes;
        meshes.now = report.time;
        if (available_.has(render::Footprint::mesh))
            for (std::size_t level = 0; level < meshes.triangles.size(); ++level)
                meshes.triangles[level] = static_cast<std::size_t>(2 * cells_) >> (2 * level);
        meshes.quads_take = quality_.expected_quads(cells_);
        return quality_.choose_mesh(meshes);
    }
    void draw(const Frame& now) {
        const FramePlan& plan = now.plan;
        const DrawLoad load{cells_, 2e5};
        if (const auto parts = plan.state.in_parts()) {
            parts_took_ += now.part_budget;
            const Milliseconds whole = time_of(*parts, load, 0);
            if (!std::exchange(parts_are_whole_, parts_took_ >= whole) && parts_took_ >= whole)
                quality_.learn_parts(*parts, now.report.cells, whole);
            return;
        }
        parts_took_ = Milliseconds(0);
        parts_are_whole_ = false;
        if (now.changed || plan.state.is_trial() || drawn_ != plan.footprint)
            under_way_.push_back({number_ + latency_,
                                  {.frame = number_,
                                   .footprint = plan.footprint,
                                   .load = load,
                                   .processor = time_of(plan.footprint, load, plan.resolution),
                                   .gpu = {},
                                   .resolution = plan.resolution}});
        drawn_ = plan.footprint;
    }
    void take_times() {
        std::vector<DrawSample> there;
        for (; !under_way_.empty() && under_way_.front().first <= number_; under_way_.pop_front())
            there.push_back(under_way_.front().second);
        quality_.learn(there);
    }

    std::mt19937 random_;
    const render::Gl gl_ = gl_without_clock();
    FrameQuality quality_;
    ExplorerState state_;
    render::FootprintSet available_ = render::FootprintSet::up_to(render::kBestFootprint);
    bool has_meshes_ = false, counted_ = false, by_pace_ = false, parts_are_whole_ = false;
    double slower_ = 1, dear_ = 4, cells_ = 0, isovalue_ = 1;
    std::uint32_t step_ = 0;
    std::optional<index::SurfacesQuery> shown_;
    Phase phase_ = Phase::rest;
    unsigned left_ = 40;
    std::uint64_t number_ = 0, latency_ = 0;
    interaction::Seconds last_change_{0};
    interaction::Seconds waited_{0};
    Milliseconds parts_took_{0};
    std::optional<render::Footprint> drawn_;
    std::deque<std::pair<std::uint64_t, DrawSample>> under_way_;
};

} // namespace isochron::app
