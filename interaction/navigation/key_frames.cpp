// Key frames of a film in a session.
#include "interaction/navigation/key_frames.h"

#include "interaction/navigation/navigation.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace isochron::interaction {
namespace {

/// Calls `visit(members...)` for each setting that a key holds as settings do.
template <class Visit, class... Records>
void each_held(Visit&& visit, Records&... r) {
    visit(r.array...);
    visit(r.isosurfaces...);
    visit(r.picked...);
    visit(r.coloring...);
    visit(r.look...);
    visit(r.bounding_box...);
    visit(r.grid...);
    visit(r.orthographic...);
    visit(r.between...);
    visit(r.mark...);
    visit(r.clip...);
    visit(r.rulers...);
    visit(r.slices...);
    visit(r.clip_box...);
    visit(r.pieces...);
    visit(r.ghosts...);
    visit(r.models...);
}

/// The view of a key for a viewer who stands elsewhere and has turned.
Similarity view_for(const KeyFrame& key, const Similarity& now, const Pose& viewer) {
    const Similarity view = key.room_from_physical.value_or(now);
    if (!key.head || *key.head == viewer || !is_finite(viewer))
        return view;
    const glm::dvec3 from(key.head->position), to(viewer.position);
    return moved(turned(view, from, {0, 1, 0}, heading(viewer) - heading(*key.head)), to - from);
}

} // namespace

std::optional<std::vector<Isosurface>> surfaces_of(const KeyFrame& key, const Settings& before) {
    if (!key.isosurfaces && !key.isovalue)
        return std::nullopt;
    std::vector<Isosurface> surfaces = key.isosurfaces.value_or(before.isosurfaces);
    if (key.isovalue)
        surfaces[std::min<std::size_t>(key.picked.value_or(before.picked), surfaces.size() - 1)]
            .isovalue = *key.isovalue;
    return surfaces;
}

void show_key(const KeyFrame& key, Settings& settings) {
    auto surfaces = surfaces_of(key, settings);
    each_held([](const auto& held, auto& setting) { setting = held.value_or(setting); }, key,
              settings);
    if (surfaces)
        settings.isosurfaces = std::move(*surfaces);
    settings.picked =
        std::min(settings.picked, static_cast<std::uint32_t>(settings.isosurfaces.size()) - 1);
    if (key.step)
        settings.instant = Instant(*key.step, key.fraction);
    if (key.room_from_physical)
        settings.room_from_physical = *key.room_from_physical;
}

Commands kept_state(Commands state) {
    if (state.keys && state.keys->empty())
        state.keys.reset();
    if (state.story == 0u)
        state.story.reset();
    return state;
}

Commands changes(const Settings& from, const Settings& to, bool undone) {
    Commands commands;
    each_setting(
        [undone](const Field& field, auto& command, const auto& before, const auto& after) {
            if ((field.undone || !undone) && !(before == after))
                command = after;
        },
        commands, from, to);
    return commands;
}

double seconds_of(std::span<const KeyFrame> keys) {
    return keys.empty() ? 0.0 : keys.back().time + keys.back().hold;
}

KeyFrame key_of(const Settings& settings, const Pose& head) {
    const Instant shown = settings.shown_instant();
    KeyFrame key{.head = head,
                 .step = shown.step,
                 .fraction = shown.fraction,
                 .room_from_physical = settings.room_from_physical};
    each_held([](auto& held, const auto& setting) { held = setting; }, key, settings);
    return key;
}

std::vector<KeyFrame> with_key(std::vector<KeyFrame> keys, KeyFrame key) {
    const double time = keys.empty() ? 0.0 : seconds_of(keys) + kKeySeconds;
    if (keys.size() < kMostKeyFrames && time + key.hold <= kLongestFilm) {
        key.time = time;
        keys.push_back(std::move(key));
    }
    return keys;
}

std::vector<KeyFrame> without_key(std::vector<KeyFrame> keys, std::size_t number) {
    keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(number));
    const double begin = keys.empty() || number > 0 ? 0.0 : keys.front().time;
    for (KeyFrame& key : keys)
        key.time -= begin;
    return keys;
}

std::vector<KeyFrame> with_moved_key(std::vector<KeyFrame> keys, std::size_t number, double time) {
    KeyFrame& key = keys[number];
    const double least =
        number == 0 ? 0.0 : keys[number - 1].time + keys[number - 1].hold + kShortestMove;
    const double most = number == 0 ? 0.0
                        : number + 1 == keys.size()
                            ? kLongestFilm - key.hold
                            : keys[number + 1].time - key.hold - kShortestMove;
    key.time = std::max(least, std::min(time, most));
    return keys;
}

std::vector<KeyFrame> with_held_key(std::vector<KeyFrame> keys, std::size_t number, double hold) {
    const double more = std::clamp(hold - keys[number].hold, -keys[number].hold,
                                   std::max(0.0, kLongestFilm - seconds_of(keys)));
    keys[number].hold += more;
    for (std::size_t i = number + 1; i < keys.size(); ++i)
        keys[i].time += more;
    return keys;
}

bool is_wide_range(double low, double high) {
    constexpr double kWide = 1000;
    return low > 0 && high > kWide * low;
}

Commands way_to_key(const KeyFrame& key, const Settings& now, const Pose& viewer) {
    Settings then = now;
    show_key(key, then);
    then.room_from_physical = view_for(key, now.room_from_physical, viewer);
    if (now.shown_instant() == then.shown_instant())
        then.instant = now.instant;
    Commands way = changes(now, then);
    if (!way.empty() && now.playback.playing) {
        way.playback = now.playback;
        way.playback->playing = false;
        way.instant = then.instant; // the frame's own step does not count
    }
    return way;
}

std::optional<std::size_t> seen_key(const Settings& now, const Pose& viewer) {
    for (std::size_t i = 0; i < now.keys.size(); ++i)
        if (way_to_key(now.keys[i], now, viewer).empty())
            return i;
    return std::nullopt;
}

std::vector<KeyFrame> turn_keys(const Settings& settings, const glm::dvec3& pivot, Instant first,
                                Instant last, double seconds) {
    constexpr int kParts = 4;
    const Similarity& view = settings.room_from_physical;
    const glm::dvec3 center = transform(view, pivot), up = view.rotation * glm::dvec3(0, 0, 1);
    std::vector<KeyFrame> keys;
    for (int i = 0; i <= kParts; ++i) {
        const double share = static_cast<double>(i) / kParts;
        KeyFrame& key = keys.emplace_back();
        key.time = share * seconds;
        key.pace = KeyPace::even;
        key.room_from_physical =
            i % kParts == 0 ? view : turned(view, center, up, share * glm::two_pi<double>());
    }
    keys.front().step = first.step;
    keys.front().fraction = first.fraction;
    keys.back().step = last.step;
    keys.back().fraction = last.fraction;
    return keys;
}

std::vector<KeyFrame> view_keys(std::span<const Viewpoint> views, const glm::dvec3& pivot) {
    constexpr double kLeast = 0.05; // [s] between views that are alike
    const auto way = [&](const Similarity& from, const Similarity& to) {
        const double cosine = std::min(std::abs(glm::dot(from.rotation, to.rotation)), 1.0);
        return glm::distance(transform(from, pivot), transform(to, pivot)) + 2 * std::acos(cosine) +
               std::abs(std::log(to.scale / from.scale));
    };
    std::vector<double> ways{0};
    for (std::size_t i = 1; i < views.size(); ++i)
        ways.push_back(way(views[i - 1].room_from_physical, views[i].room_from_physical));
    const double all = std::accumulate(ways.begin(), ways.end(), 0.0);
    const double seconds = kViewSeconds * static_cast<double>(views.size() - 1);
    std::vector<KeyFrame> keys;
    for (std::size_t i = 0; i < views.size(); ++i) {
        KeyFrame key;
        if (i > 0)
            key.time = keys.back().time + std::max(kLeast, all > 0 ? ways[i] / all * seconds : 0);
        key.pace = KeyPace::even;
        key.room_from_physical = views[i].room_from_physical;
        keys.push_back(std::move(key));
    }
    return keys;
}

} // namespace isochron::interaction
