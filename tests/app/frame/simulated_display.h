// A display without GL: a test sets the cost of footprints, which becomes known some frames later.
#pragma once

#include "app/quality/quality_controller.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <random>
#include <vector>

namespace isochron::app {

/// Runs a controller against true costs and remembers every frame.
class SimulatedDisplay {
  public:
    /// Time of a frame [ms].
    using Cost = std::function<double(render::Footprint, const DrawLoad&)>;

    struct Frame {
        QualityChoice choice;
        bool drawn = false;
        double cost = 0; ///< [ms], 0 unless drawn
    };

    Cost cost;
    int latency = 0;   ///< frames until a measurement is there
    bool still = true; ///< nothing moves: only what changes is drawn
    /// A surface whose time is only guessed is drawn in the time that frames leave.
    bool draws_ahead = false;
    int drawn_ahead = 0; ///< how often
    QualityInput input = settled_input();
    QualityController controller;
    std::vector<Frame> frames;

    SimulatedDisplay(double budget, Cost true_cost)
        : cost(std::move(true_cost)), controller(Milliseconds(budget)) {}

    /// A settled picture of some cells that any footprint can draw.
    static QualityInput settled_input() {
        QualityInput input;
        input.pace = interaction::Pace::settled;
        // A ladder of three rungs: nothing comes with a mesh.
        input.available.remove(render::Footprint::mesh);
        input.load = {1e4, 1e6};
        return input;
    }

    const Frame& frame() {
        while (!under_way_.empty() && under_way_.front().there <= number_) {
            const Sample& sample = under_way_.front();
            controller.measured(sample.footprint, sample.load, Milliseconds(sample.cost));
            under_way_.pop_front();
        }
        Frame now;
        now.choice = controller.advance(input);
        const bool moving = input.pace == interaction::Pace::moving || input.playing || !still;
        const Picture picture{now.choice.footprint, input.load};
        if (moving || now.choice.measure || picture != shown_) {
            shown_ = picture;
            now.drawn = true;
            now.cost = cost(picture.footprint, input.load);
            under_way_.push_back({number_ + latency + 1, picture.footprint, input.load, now.cost});
        }
        if (draws_ahead)
            draw_ahead(now.cost);
        ++number_;
        frames.push_back(now);
        return frames.back();
    }
    const Frame& run(int count) {
        for (int i = 0; i < count; ++i)
            frame();
        return frames.back();
    }

    double budget() const { return controller.budget().count(); }
    /// Frames since `first` that took longer than the budget.
    int over_budget(std::size_t first = 0) const {
        int count = 0;
        for (std::size_t i = first; i < frames.size(); ++i)
            count += frames[i].cost > budget();
        return count;
    }
    int at(render::Footprint footprint, std::size_t first = 0) const {
        int count = 0;
        for (std::size_t i = first; i < frames.size(); ++i)
            count += frames[i].choice.footprint == footprint;
        return count;
    }

  private:
    struct Picture {
        render::Footprint footprint;
        DrawLoad load;
        bool operator==(const Picture&) const = default;
    };
    struct Sample {
        int there; ///< frame number
        render::Footprint footprint;
        DrawLoad load;
        double cost;
    };
    void draw_ahead(double taken) {
        if (!controller.surface_is_guessed(input)) {
            ahead_ = 0;
            return;
        }
        ahead_ += std::max(0.8 * budget() - taken, 0.0);
        const double whole = cost(render::Footprint::surface, input.load);
        if (ahead_ < whole)
            return;
        controller.measured_in_parts(render::Footprint::surface, input.load, Milliseconds(whole));
        ++drawn_ahead;
        ahead_ = 0;
    }

    int number_ = 0;
    double ahead_ = 0; ///< [ms] spent on the surface that is drawn now
    std::optional<Picture> shown_;
    std::deque<Sample> under_way_;
};

} // namespace isochron::app
