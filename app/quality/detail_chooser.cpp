// Chooses numbers of cells and levels of detail.
#include "app/quality/detail_chooser.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace isochron::app {
namespace {

constexpr double kUp = 1.2;   ///< a number of cells is chosen once it fits so many times
constexpr double kDown = 0.9; ///< and given up once less than this share of it fits
constexpr int kMostSteps = 8; ///< most steps of growth at a time: 16 times as many cells
/// Where less is seen than this share of what was seen when the number was chosen, the number does
/// not grow.
constexpr double kAsMuchSeen = 0.9;
constexpr double kStay = 0.25; ///< [levels] a wish stays until it is this far out of its range
/// How many levels finer than a pixel the voxels are at rest, at first and in the end: where cells
/// share a pixel, its light changes with the next level until the cells are far below a pixel.
constexpr double kFinerAtFirst = 0.5, kFinerAtLast = 2;
constexpr double kUnseen = 2; ///< how many levels coarser unseen regions may be at rest
/// Regions that no eye sees even if it turns by so much [rad] have no part in what moves.
constexpr double kTurned = 15 * std::numbers::pi / 180;
constexpr std::uint64_t kEighths = 8; ///< all cells over the least by which they are recognized
constexpr double kNearest = -8, kFarthest = 8;
constexpr int kParts = index::DetailQuery::kPartsOfLevel;

/// The numbers of cells to choose from: each is larger than the one before by a half or a third.
std::uint64_t cells_of(int step) {
    const std::uint64_t base = DetailChooser::kFewest << (step / 2);
    return step % 2 == 0 ? base : base + base / 2;
}

/// Pixels along a voxel at a distance of a meter; in a parallel view, at any.
double pixels_at_one_meter(const render::View& view, double voxel) {
    const glm::vec2 scale = 0.5f * glm::vec2(view.size) *
                            glm::vec2(glm::length(glm::vec3(view.clip_from_eye[0])),
                                      glm::length(glm::vec3(view.clip_from_eye[1])));
    return voxel * std::max(scale.x, scale.y);
}

/// The perspective with each of its sides turned outwards by kTurned.
glm::mat4 widened(const glm::mat4& clip_from_eye) {
    glm::mat4 wide = clip_from_eye;
    if (clip_from_eye[3][3] == 1.0f) // parallel
        return wide;
    for (int axis = 0; axis < 2; ++axis) {
        constexpr double kMost = 89 * std::numbers::pi / 180;
        const double scale = clip_from_eye[axis][axis], shift = clip_from_eye[2][axis];
        const double high = std::min(std::atan((1 + shift) / scale) + kTurned, kMost);
        const double low = std::max(std::atan((shift - 1) / scale) - kTurned, -kMost);
        const double width = std::tan(high) - std::tan(low);
        wide[axis][axis] = static_cast<float>(2 / width);
        wide[2][axis] = static_cast<float>((std::tan(high) + std::tan(low)) / width);
    }
    return wide;
}

/// Whether a box in index space may be seen: not all of its corners lie beyond one side.
bool may_be_seen(const glm::mat4& clip_from_index, const glm::vec3& low, const glm::vec3& high) {
    std::array<int, 5> beyond{};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at =
            glm::mix(low, high, glm::vec3(corner & 1, corner >> 1 & 1, corner >> 2));
        const glm::vec4 p = clip_from_index * glm::vec4(at, 1.0f);
        beyond[0] += p.x < -p.w;
        beyond[1] += p.x > p.w;
        beyond[2] += p.y < -p.w;
        beyond[3] += p.y > p.w;
        beyond[4] += p.w <= 0.0f;
    }
    return std::ranges::find(beyond, 8) == beyond.end();
}

} // namespace

DetailChooser::DetailChooser(const index::Grid& grid, std::uint64_t most)
    : regions_(grid), most_(most), small_(grid.cell_count() <= kSmallVolume) {
    for (std::size_t i = 0; i < regions_.size(); ++i)
        boxes_.push_back(box_of(i, grid));
}

DetailChooser::Box DetailChooser::box_of(std::size_t region, const index::Grid& grid) const {
    const auto at = regions_.at(region);
    Box box{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const std::uint32_t first = at[a] * regions_.edge();
        const std::uint32_t last = std::min(first + regions_.edge(), grid.cells()[a]);
        box.low[axis] = static_cast<float>(grid.even_place(axis, first));
        box.high[axis] = static_cast<float>(grid.even_place(axis, last));
        box.cell[axis] = (box.high[axis] - box.low[axis]) / static_cast<float>(last - first);
    }
    return box;
}

void DetailChooser::look(std::span<const render::View> views, const render::Placement& placement) {
    ideal_.assign(views.empty() ? 0 : regions_.size(), kFarthest);
    visible_.assign(ideal_.size(), false);
    beside_.assign(ideal_.size(), true);
    const glm::vec3 spacing = placement.spacing();
    for (const render::View& view : views) {
        const glm::mat4 clip_from_index =
            view.clip_from_eye * view.eye_from_room * placement.room_from_index;
        const glm::mat4 wide_from_index =
            widened(view.clip_from_eye) * view.eye_from_room * placement.room_from_index;
        const glm::vec3 eye(glm::inverse(placement.room_from_index) *
                            glm::vec4(view.eye_in_room(), 1.0f));
        for (std::size_t i = 0; i < ideal_.size(); ++i) {
            const auto& [low, high, cell] = boxes_[i];
            const glm::vec3 sides = cell * spacing;
            const double pixels = pixels_at_one_meter(view, std::max({sides.x, sides.y, sides.z}));
            const glm::vec3 beside = eye - glm::clamp(eye, low, high);
            const double distance =
                view.is_parallel() ? 1.0
                                   : glm::length(glm::mat3(placement.room_from_index) * beside);
            const bool is_seen = may_be_seen(clip_from_index, low, high);
            visible_[i] = visible_[i] || is_seen;
            if (beside_[i] && may_be_seen(wide_from_index, low, high))
                beside_[i] = false;
            const double level =
                std::log2(std::max(distance, 1e-3) / pixels) + (is_seen ? 0.0 : kUnseen);
            ideal_[i] = std::clamp(std::min(ideal_[i], level), kNearest, kFarthest);
        }
    }
    seen_ = static_cast<double>(std::ranges::count(visible_, true)) /
            static_cast<double>(std::max<std::size_t>(visible_.size(), 1));
}

bool DetailChooser::cells_look_small() const {
    return !ideal_.empty() && std::exp2(-std::ranges::min(ideal_)) <= kSmallCell;
}

index::DetailQuery DetailChooser::for_motion(std::optional<double> fit, std::uint64_t drawn,
                                            std::uint64_t least) {
    const double cells = fit.value_or(static_cast<double>(kAtFirst));
    const auto holds = [&](int step, double share) {
        return share * static_cast<double>(cells_of(step)) <= cells;
    };
    const int before = step_;
    if (step_ < 0)
        while (holds(step_ + 1, 1))
            ++step_;
    while (step_ > 0 && !holds(step_, kDown))
        --step_;
    step_ = std::max(step_, 0);
    if (drawn == cells_of(step_) && drawn < most_ && seen_ >= kAsMuchSeen * seen_then_)
        for (int more = 0; more < kMostSteps && holds(step_ + 1, kUp); ++more)
            ++step_;
    while (cells_of(step_) < std::min(least, most_))
        ++step_;
    if (step_ != before)
        seen_then_ = seen_;
    kept_.resize(ideal_.size());
    // Where all cells fit, those that nobody sees need not be found again when somebody turns.
    const bool scarce = cells_of(step_) < kEighths * least;
    for (std::size_t i = 0; i < ideal_.size(); ++i) {
        const double wish = kParts * (scarce && beside_[i] ? kFarthest : ideal_[i]);
        if (wish < kept_[i] - kParts * kStay || wish >= kept_[i] + 1 + kParts * kStay)
            kept_[i] = static_cast<std::int8_t>(std::floor(wish));
    }
    return {std::min(cells_of(step_), most_), false, kept_};
}

bool DetailChooser::lacks_what_is_seen(const index::DetailQuery& chosen) const {
    constexpr std::ptrdiff_t kPart = 20; // share of the regions that are seen
    if (chosen.wished.size() != ideal_.size())
        return false;
    std::ptrdiff_t without = 0;
    for (std::size_t i = 0; i < ideal_.size(); ++i)
        without += visible_[i] && chosen.wished[i] >= kParts * kFarthest && ideal_[i] < kFarthest;
    return kPart * without > std::ranges::count(visible_, true);
}

index::DetailQuery DetailChooser::at_first_rest(std::uint64_t cells) const {
    return resting(cells, kFinerAtFirst);
}

index::DetailQuery DetailChooser::at_rest() const {
    return resting(most_, kFinerAtLast);
}

/// @param finer how many levels finer than a pixel the voxels are
index::DetailQuery DetailChooser::resting(std::uint64_t cells, double finer) const {
    index::DetailQuery query{std::min(cells, most_), true, {}};
    const auto level = [finer](double ideal) {
        return static_cast<std::int8_t>(kParts * std::max(std::floor(ideal - finer), 0.0));
    };
    if (std::ranges::any_of(ideal_, [&](double ideal) { return level(ideal) > 0; }))
        for (const double ideal : ideal_)
            query.wished.push_back(level(ideal));
    return query;
}

} // namespace isochron::app
