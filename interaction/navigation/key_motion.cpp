// Motion through keys.
#include "interaction/navigation/key_motion.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::interaction {
namespace {

/// Share of a move that is done after a share of its time: a cubic from 0 to 1. It is monotone for
/// slopes from 0 to 3.
double done(double time, double first, double last) {
    const double left = 1 - time;
    return time * time * (3 - 2 * time) + first * time * left * left - last * time * time * left;
}

/// Share of a number's change, for a share of the change of the scale's logarithm.
double in_proportion(double share, double growth) {
    return growth == 0 ? share : std::expm1(growth * share) / std::expm1(growth);
}

/// The slope at a key between two slopes, by the harmonic mean; 0 where the number turns back.
/// @param before, after lengths of the moves [s]
double slope_between(double left, double right, double before, double after) {
    if (!(left * right > 0))
        return 0;
    const double a = before + 2 * after, b = 2 * before + after;
    return (a + b) / (a / right + b / left);
}

/// The two moves that meet at a key, if nothing rests there.
struct Meeting {
    bool passes = false;
    std::size_t before = 0, after = 0;
};
Meeting meeting_at(const KeyTimes& times, std::size_t key) {
    const std::size_t last = times.at.size() - 1;
    if (times.rests(key))
        return {};
    return {true, (key == 0 ? last : key) - 1, key == last ? 0 : key};
}

glm::dquat turned_by(const glm::dvec3& turn, const glm::dquat& from) {
    const double angle = glm::length(turn);
    return angle > 0 ? glm::normalize(glm::angleAxis(angle, turn / angle) * from) : from;
}

glm::dvec3 turn_between(const glm::dquat& from, const glm::dquat& to) {
    glm::dquat turn = to * glm::conjugate(from);
    if (turn.w < 0)
        turn = -turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    return sine > 0 ? axis * (2 * std::atan2(sine, turn.w) / sine) : glm::dvec3(0);
}

/// The derivative of the rotation vector `turn` for an angular velocity: the inverse of the left
/// Jacobian of SO(3) (Chirikjian, Stochastic Models, Information Theory, and Lie Groups 2, 2012,
/// doi:10.1007/978-0-8176-4944-9).
glm::dvec3 rate_of_turn(const glm::dvec3& turn, const glm::dvec3& velocity) {
    const double angle = glm::length(turn);
    const double factor =
        angle < 1e-4 ? 1.0 / 12 : (1 - angle / 2 / std::tan(angle / 2)) / (angle * angle);
    const glm::dvec3 across = glm::cross(turn, velocity);
    return velocity - across / 2.0 + factor * glm::cross(turn, across);
}

/// The place of the data that moves least in the room, in the sense of least squares; close to
/// `pivot` where the keys leave it open.
glm::dvec3 still_place(const std::vector<Similarity>& values, glm::dvec3 pivot) {
    pivot.z *= values.front().exaggeration;
    const auto axes = [](const Similarity& value) {
        return glm::mat3_cast(value.rotation) * value.scale;
    };
    const double count = static_cast<double>(values.size());
    glm::dmat3 mean(0.0);
    glm::dvec3 place(0.0);
    double size = 0;
    for (const Similarity& value : values) {
        mean += axes(value) / count;
        place += (value.translation + axes(value) * pivot) / count;
        size += value.scale * value.scale;
    }
    constexpr double kOpen = 1e-3; // share of the scale below which a direction counts as open
    glm::dmat3 squares(kOpen * size);
    glm::dvec3 sum(0.0);
    for (const Similarity& value : values) {
        const glm::dmat3 off = axes(value) - mean;
        squares += glm::transpose(off) * off;
        sum += glm::transpose(off) * (value.translation + axes(value) * pivot - place);
    }
    return pivot - glm::inverse(squares) * sum;
}

template <class Part>
auto each_of(const std::vector<Similarity>& values, const Part& part) {
    std::vector<decltype(part(values.front()))> parts;
    for (const Similarity& value : values)
        parts.push_back(part(value));
    return parts;
}

constexpr double kMostGrowth = 500; ///< whose exponential is finite

std::vector<double> growth_of(const std::vector<Similarity>& values) {
    std::vector<double> growth;
    for (std::size_t i = 0; i + 1 < values.size(); ++i)
        growth.push_back(std::clamp(std::log(values[i + 1].scale) - std::log(values[i].scale),
                                    -kMostGrowth, kMostGrowth));
    return growth;
}

glm::dvec3 place_of(const Similarity& value, const glm::dvec3& center) {
    return value.translation + value.scale * (value.rotation * center);
}

} // namespace

KeyPlace KeyTimes::place(double time) const {
    const auto behind = std::ranges::upper_bound(at, time, {}, &KeyTime::arrives);
    if (behind == at.begin())
        return {};
    const std::size_t key = static_cast<std::size_t>(behind - at.begin()) - 1;
    if (behind == at.end() || time <= at[key].leaves)
        return {key, 0};
    return {key, (time - at[key].leaves) / lasts(key)};
}

bool KeyTimes::rests(std::size_t key) const {
    const auto held = [](const KeyTime& each) { return each.leaves > each.arrives; };
    if (key == 0 || key + 1 == at.size())
        return !closed || at.size() < 3 || held(at.front()) || held(at.back());
    return held(at[key]);
}

KeyedNumber::KeyedNumber(const KeyTimes& times, std::vector<double> values, bool even,
                         std::vector<double> growth)
    : values_(std::move(values)), moves_(values_.size() - 1) {
    std::vector<double> first, last; // slopes at the ends of each move, at the even pace [1/s]
    for (std::size_t i = 0; i < moves_.size(); ++i) {
        const double change = (values_[i + 1] - values_[i]) / times.lasts(i);
        double& g = moves_[i].growth = growth.empty() ? 0.0 : growth[i];
        first.push_back(g == 0 ? change : change * g / std::expm1(g));
        last.push_back(g == 0 ? change : first.back() * std::exp(g));
    }
    for (std::size_t key = 0; key < values_.size(); ++key) {
        const Meeting moves = meeting_at(times, key);
        if (!moves.passes)
            continue;
        const double slope = slope_between(last[moves.before], first[moves.after],
                                           times.lasts(moves.before), times.lasts(moves.after));
        if (slope != 0) {
            moves_[moves.before].last = slope / last[moves.before];
            moves_[moves.after].first = slope / first[moves.after];
        }
    }
    for (std::size_t i = 0; even && i < moves_.size(); ++i)
        if (times.at[i].even)
            moves_[i].first = moves_[i].last = 1;
}

double KeyedNumber::at(const KeyPlace& place) const {
    const double from = values_[place.key];
    if (place.share == 0)
        return from;
    const double to = values_[place.key + 1];
    const Move& move = moves_[place.key];
    const double share = in_proportion(done(place.share, move.first, move.last), move.growth);
    return std::clamp(from + (to - from) * share, std::min(from, to), std::max(from, to));
}

KeyedTurn::KeyedTurn(const KeyTimes& times, std::vector<glm::dquat> values)
    : values_(std::move(values)), moves_(values_.size() - 1) {
    for (std::size_t i = 0; i < moves_.size(); ++i)
        moves_[i].turn = turn_between(values_[i], values_[i + 1]);
    for (std::size_t key = 0; key < values_.size(); ++key) {
        const Meeting meeting = meeting_at(times, key);
        if (!meeting.passes)
            continue;
        Move &before = moves_[meeting.before], &after = moves_[meeting.after];
        const double left = glm::length(before.turn), right = glm::length(after.turn);
        if (left == 0 || right == 0)
            continue;
        const glm::dvec3 a = before.turn / left, b = after.turn / right;
        const double along = glm::dot(a, b); // two axes: the faster, the less they differ
        if (along <= 0)
            continue;
        const double took = times.lasts(meeting.before), takes = times.lasts(meeting.after);
        const glm::dvec3 velocity =
            glm::normalize(a + b) * along * slope_between(left / took, right / takes, took, takes);
        before.last = rate_of_turn(before.turn, velocity * took);
        after.first = velocity * takes;
    }
}

glm::dquat KeyedTurn::at(const KeyPlace& place) const {
    const glm::dquat& from = values_[place.key];
    if (place.share == 0)
        return from;
    const Move& move = moves_[place.key];
    const double time = place.share, left = 1 - time;
    return turned_by(move.turn * done(time, 0, 0) + move.first * (time * left * left) -
                         move.last * (time * time * left),
                     from);
}

KeyedPosition::KeyedPosition(const KeyTimes& times, const std::vector<glm::dvec3>& values,
                             const std::vector<double>& growth) {
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> along;
        for (const glm::dvec3& value : values)
            along.push_back(value[axis]);
        axes_.emplace_back(times, std::move(along), false, growth);
    }
}

glm::dvec3 KeyedPosition::at(const KeyPlace& place) const {
    return {axes_[0].at(place), axes_[1].at(place), axes_[2].at(place)};
}

KeyedSimilarity::KeyedSimilarity(const KeyTimes& times, std::vector<Similarity> values,
                                 const glm::dvec3& pivot)
    : values_(std::move(values)), center_(still_place(values_, pivot)),
      position_(times, each_of(values_, [&](const Similarity& v) { return place_of(v, center_); }),
                growth_of(values_)),
      turn_(times, each_of(values_, [](const Similarity& v) { return v.rotation; })),
      scale_(times, each_of(values_, [](const Similarity& v) { return std::log(v.scale); })),
      exaggeration_(
          times, each_of(values_, [](const Similarity& v) { return std::log(v.exaggeration); })) {}

Similarity KeyedSimilarity::at(const KeyPlace& place) const {
    Similarity value = values_[place.key];
    if (place.share == 0)
        return value;
    const Similarity& next = values_[place.key + 1];
    value.rotation = turn_.at(place);
    if (next.scale != value.scale)
        value.scale = std::exp(scale_.at(place));
    if (next.exaggeration != value.exaggeration)
        value.exaggeration = std::exp(exaggeration_.at(place));
    value.translation = position_.at(place) - value.scale * (value.rotation * center_);
    return value;
}

} // namespace isochron::interaction
