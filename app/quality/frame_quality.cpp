// The quality of a session's frames.
#include "app/quality/frame_quality.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::app {
namespace {

Milliseconds period_of(const Config& config, std::optional<double> refresh_rate) {
    const double limit = config.rendering.frame_rate_limit;
    return Milliseconds(1e3 / std::min(refresh_rate.value_or(limit), limit));
}

/// Time without motion after which a picture that still changes, as the head sways, is not expected
/// to become still.
constexpr interaction::Seconds kNeverStill{1};
/// Longest time at rest that goes into trying footprints before parts begin.
constexpr interaction::Seconds kTrialsAtRest{0.15};

} // namespace

FrameQuality::FrameQuality(const render::Gl& gl, const Config& config,
                           std::optional<double> refresh_rate)
    : settled_(config.quality.settled), wanted_budget_(config.quality.frame_budget_ms),
      still_budget_(config.quality.still_budget_ms), longest_(config.quality.longest_ms),
      configured_period_(period_of(config, refresh_rate)), period_(configured_period_),
      promise_(promise_for(wanted_budget_.count() > 0 ? wanted_budget_ : period_, false)),
      resolution_(config.quality.least_resolution), steady_(promise_.wanted()),
      still_(std::max(steady_.budget(), still_budget_)), meter_(gl) {}

/// A headset's runtime moves pictures itself, but at the headset's rate.
MotionPromise FrameQuality::promise_for(Milliseconds wanted, bool in_headset) const {
    if (in_headset)
        return MotionPromise(wanted);
    const Milliseconds all = wanted_budget_.count() > 0 ? wanted : MotionPromise::kAtEase;
    return MotionPromise(wanted, {.all = std::min(all, longest_), .least = longest_});
}

void FrameQuality::set_headset_period(std::optional<Milliseconds> period) {
    // Runtimes tell their period to the nanosecond, and it varies a little.
    constexpr double kSame = 0.02;
    const Milliseconds wanted = period.value_or(configured_period_);
    if (!(wanted.count() > 0) || std::abs(wanted / period_ - 1) < kSame)
        return;
    period_ = wanted;
    if (wanted_budget_.count() > 0)
        return;
    promise_ = promise_for(period_, period.has_value());
    steady_ = QualityController(period_);
    still_ = QualityController(std::max(period_, still_budget_));
}

std::vector<DrawSample> FrameQuality::collect(FrameLog& log) {
    std::vector<DrawSample> samples = meter_.finished();
    for (const DrawSample& sample : samples)
        if (sample.gpu)
            log.set_gpu(sample.frame, *sample.gpu);
    return samples;
}

void FrameQuality::learn(std::span<const DrawSample> samples) {
    for (const DrawSample& sample : samples) {
        // The first picture of all makes what all further ones have, such as the panel's font.
        if (sample.load.cells <= 0 && !std::exchange(begun_, true))
            continue;
        Milliseconds cost = sample.cost();
        if (sample.resolution > 0) {
            const auto all = steady_.expected(sample.footprint, sample.load);
            const double share = all ? cost / *all : 1;
            const double likely = resolution_.learn(sample.resolution, share);
            if (!all || likely == share)
                continue;
            // What is known of all pixels is wrong, and no picture in all pixels might come to tell.
            cost /= likely;
        }
        for (QualityController* controller : {&steady_, &still_})
            controller->measured(sample.footprint, sample.load, cost);
    }
}

/// Empty before the first measurement.
std::optional<MotionCosts> FrameQuality::motion_costs() const {
    constexpr double kMany = 1e6;
    const auto cost = [&](double cells) {
        return steady_.expected(render::Footprint::quad, {cells * charged_.cells, charged_.pixels});
    };
    const auto none = cost(0), many = cost(kMany);
    if (!none || !many || !(*many > *none))
        return std::nullopt;
    // A configured budget is one for drawing alone.
    const Milliseconds beside = wanted_budget_.count() > 0 ? Milliseconds(0) : beside_;
    return MotionCosts{beside, *none, (*many - *none) / kMany, least_share()};
}

/// Promises a time for moving pictures; what presenting leaves of it is their budget.
void FrameQuality::keep_promise(FrameReport& report, Choosing how) {
    constexpr double kLeastDrawing = 0.25; // share of the promise
    if (report.volume_cells) {
        all_cells_ = report.volume_cells;
        counted_ = true;
    } else if (!counted_ && report.cells > 0 && longest_ > promise_.wanted()) {
        // Before a first rest nobody has counted: each level has about a quarter of the cells of the
        // next finer one. Where no longer time may be promised, a guess would break the budget.
        all_cells_ = report.cells << (report.finest + report.coarsest);
    }
    if (how == Choosing::with_parts) {
        const auto costs = motion_costs();
        promise_.update(costs, all_cells_, report.time);
        const Milliseconds time = promise_.time();
        const Milliseconds budget =
            std::max(time - (costs ? costs->beside : Milliseconds(0)), kLeastDrawing * time);
        steady_.set_budget(budget);
        still_.set_budget(std::max(budget, still_budget_));
    }
    report.promised = promise_.time();
    report.slower = promise_.time() > promise_.wanted();
}

bool FrameQuality::fits_in_motion(std::uint64_t cells, bool moves) const {
    constexpr double kTakenUp = 0.85;
    const auto cost = steady_.expected(
        render::Footprint::quad, {static_cast<double>(cells) * charged_.cells, charged_.pixels});
    return cost && least_share() * *cost <= (moves ? 1.0 : kTakenUp) * steady_.budget();
}

bool FrameQuality::may_be_shown_in_motion(std::uint64_t cells) const {
    const auto cost = steady_.expected(
        render::Footprint::quad, {static_cast<double>(cells) * charged_.cells, charged_.pixels});
    return cost && *cost <= std::max(steady_.budget(), longest_);
}

FramePlan FrameQuality::choose(const ExplorerState& state, bool changed, Choosing how,
                               render::FootprintSet available, render::FootprintSet possible,
                               FrameReport& report) {
    keep_promise(report, how);
    if (changed)
        changed_at_ = report.time;
    // Where slices stand alone, no cell is drawn: nothing is to be measured or to become finer.
    if (how == Choosing::with_parts && state.slices.hides_surfaces()) {
        resting_.reset();
        report.budget = steady_.budget();
        return {.footprint = render::kBestFootprint,
                .reason = QualityReason::fits,
                .state = PictureState::drawn(true, false)};
    }
    const bool still = report.time - changed_at_ >= kStillAfter;
    QualityInput input;
    input.pace = report.pace;
    input.mode = state.quality;
    // A step that stands for long is a picture at rest.
    input.playing = state.playback.playing && report.pace == interaction::Pace::moving;
    input.settled = settled_;
    input.by_pace = how == Choosing::by_pace;
    if (input.by_pace)
        input.settled = input.settled.value_or(render::kBestFootprint);
    input.load = {static_cast<double>(report.cells) * charged_.cells, charged_.pixels};
    // Splats are for the paper's pair, and for pictures at rest of who asks for them.
    const bool splats = input.by_pace || input.mode == interaction::QualityMode::paper ||
                        (settled_ && input.pace != interaction::Pace::moving);
    for (render::FootprintSet* set : {&available, &possible})
        if (!splats)
            set->remove(render::Footprint::gaussian);
    input.available = available;
    // A button that moves nothing drops no picture; what is asked for anew comes first.
    if (resting_ && still && report.shown == report.asked)
        input.pace = interaction::Pace::settled;
    const auto in_the_end = partial(input, how);
    // An idle session draws no frames: a longer time was a wait, in which no head swayed.
    constexpr interaction::Seconds kLongestFrame{0.5};
    const interaction::Seconds frame = std::min(report.time - frame_before_, kLongestFrame);
    swayed_for_ = still || report.pace == interaction::Pace::moving ? interaction::Seconds{0}
                                                                    : swayed_for_ + frame;
    frame_before_ = report.time;
    input.in_parts = in_the_end;
    const bool parts = still && in_the_end;
    QualityInput resting_input = input;
    if (parts) {
        input.settled.reset();
        resting_input.settled.reset();
        // Meshes that come at rest are for later motion: what is shown stays.
        resting_input.available.remove(render::Footprint::mesh);
        if (resting_ && resting_->input == resting_input) {
            report.budget = steady_.budget();
            report.expected = resting_->cost;
            report.better = steady_.expected(*input.in_parts, input.load);
            return resting_->plan;
        }
    }
    const bool pauses = still && !parts && report.pace != interaction::Pace::moving;
    QualityController& controller = pauses ? still_ : steady_;
    QualityInput with_mesh = input;
    with_mesh.available = possible;
    const QualityChoice with_all = controller.choose(with_mesh);
    const QualityChoice choice = controller.advance(input);
    FramePlan plan{.footprint = choice.footprint, .reason = choice.reason, .state = {}};
    // A trial of the exact surface comes first where both are next.
    plan.mesh = with_all.footprint == render::Footprint::mesh &&
                choice.footprint <= render::Footprint::mesh;
    if (how == Choosing::with_parts && !still && input.mode == interaction::QualityMode::automatic)
        plan.resolution = choose_resolution(choice, report);
    // What a mesh or parts may still change is not final.
    plan.finer_in_parts = in_the_end && *in_the_end != choice.footprint;
    const bool parts_come = plan.finer_in_parts && swayed_for_ < kNeverStill;
    const bool all_pixels = plan.resolution == 0;
    plan.state = PictureState::drawn(all_pixels && choice.final && with_all.final &&
                                         choice.footprint == with_all.footprint && !parts_come,
                                     all_pixels && choice.measure);
    plan.state.draw_ahead(how == Choosing::with_parts && !still &&
                          steady_.surface_is_guessed(input));
    report.retries = choice.retries;
    report.budget = controller.budget();
    report.expected = choice.cost;
    report.better = choice.better_cost;
    resting_.reset();
    const bool measured = choice.final || report.time - changed_at_ >= kStillAfter + kTrialsAtRest;
    if (parts && measured && choice.footprint != *input.in_parts) {
        resting_ = {resting_input, plan, choice.cost};
        resting_->plan.state.make_parts(*input.in_parts);
    }
    return plan;
}

/// Pixels are given up before cells are.
std::size_t FrameQuality::choose_resolution(const QualityChoice& choice,
                                            const FrameReport& report) {
    return choice.footprint == render::Footprint::quad && report.cells > 0
               ? resolution_.choose(choice.cost, steady_.budget(), report.time)
               : 0;
}

/// The share of the time in all pixels that a moving picture takes in as few as are drawn before
/// cells are given up.
double FrameQuality::least_share() const {
    return std::min(resolution_.share(CellResolution::kBeforeCells), 1.0);
}

/// The footprint that this picture at rest is to have in the end, if it is made in parts.
std::optional<render::Footprint> FrameQuality::partial(const QualityInput& input,
                                                       Choosing how) const {
    if (how != Choosing::with_parts || !(still_budget_.count() > 0) || input.playing ||
        input.mode != interaction::QualityMode::automatic ||
        input.pace != interaction::Pace::settled || input.load.cells <= 0)
        return std::nullopt;
    return input.available.best(settled_.value_or(render::kBestFootprint));
}

Milliseconds FrameQuality::left_of_frame(Milliseconds taken) const {
    constexpr double kShare = 0.8; // as frames take now more and now less
    constexpr Milliseconds kLeast{2};
    const Milliseconds left = kShare * steady_.budget() - taken;
    return left >= kLeast ? left : Milliseconds(0);
}

Milliseconds FrameQuality::part_budget() const {
    // Shorter parts would take longer in all; longer parts would delay the answer to the next
    // input.
    constexpr Milliseconds kLeast{8}, kMost{50};
    return std::min(still_budget_, std::clamp(steady_.budget(), kLeast, kMost));
}

void FrameQuality::learn_parts(render::Footprint footprint, std::uint64_t cells,
                               Milliseconds time) {
    const DrawLoad load{static_cast<double>(cells) * charged_.cells, charged_.pixels};
    for (QualityController* controller : {&steady_, &still_})
        controller->measured_in_parts(footprint, load, time);
}

std::optional<double> FrameQuality::cells_that_fit(interaction::Pace pace) const {
    constexpr double kShare = 0.75;
    const auto costs = motion_costs();
    if (!costs)
        return std::nullopt;
    const bool moves = pace == interaction::Pace::moving;
    const double share = moves ? MotionPromise::kRoom : kShare;
    const Milliseconds budget = (moves ? steady_ : still_).budget();
    const Milliseconds room = share * budget / (moves ? least_share() : 1.0);
    return std::max(0.0, (room - costs->fixed) / costs->of_cell);
}

namespace {

/// Quads are drawn of cells; triangles count as many cells as have so many in the mesh of all.
constexpr double kTrianglesOfCell = 2;

} // namespace

std::optional<Milliseconds> FrameQuality::expected_mesh(std::size_t triangles) const {
    constexpr double kQuadsOfTriangle =
        1.5; // that take as long as one of a simplified mesh, at most
    const double cells = static_cast<double>(triangles) * charged_.cells;
    const auto known =
        steady_.expected(render::Footprint::mesh, {cells / kTrianglesOfCell, charged_.pixels});
    return known ? known
                 : steady_.expected(render::Footprint::quad,
                                    {kQuadsOfTriangle * cells, charged_.pixels});
}

std::optional<std::size_t> FrameQuality::choose_mesh(MeshesAtHand meshes) {
    meshes.budget = steady_.budget();
    meshes.longest = std::max(meshes.budget, longest_);
    meshes.expected = [this](std::size_t count) { return expected_mesh(count); };
    return mesh_levels_.choose(meshes);
}

void FrameQuality::charge(const DrawLoad& of_cell,
                          std::span<const interaction::Isosurface> surfaces) {
    const auto layers = std::ranges::count_if(surfaces, [](const interaction::Isosurface& surface) {
        return surface.of_shown_array() && surface.opacity > 0 && surface.opacity < 1;
    });
    passes_ = static_cast<double>(layers + (interaction::any_is(surfaces, false) ? 1 : 0));
    passes_ = std::max(passes_, 1.0);
    charged_ = {of_cell.cells * passes_, of_cell.pixels};
}

void FrameQuality::begin(std::uint64_t frame) {
    meter_.begin(frame);
}

void FrameQuality::end(const FrameReport& report, const DrawLoad& of_cell, Milliseconds processor) {
    view_ = of_cell;
    const double cells = report.triangles > 0
                             ? static_cast<double>(report.triangles) / kTrianglesOfCell
                             : static_cast<double>(report.cells);
    meter_.end(report.footprint, {cells * view_.cells * passes_, view_.pixels}, processor,
               report.resolution);
}

unsigned FrameQuality::missed(interaction::Seconds between) const {
    // With a budget longer than the display's period, that many missed refreshes are intended.
    const double periods = between / std::max(period_, promise_.time());
    return static_cast<unsigned>(std::clamp(std::round(periods) - 1.0, 0.0, 1e9));
}

} // namespace isochron::app
