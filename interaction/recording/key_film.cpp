// Key frames of a film become recorded frames.
#include "interaction/recording/key_film.h"

#include "interaction/command_fields.h"
#include "interaction/error.h"
#include "interaction/navigation/key_motion.h"
#include "interaction/navigation/story.h"
#include "interaction/recording/commands_json.h"
#include "interaction/recording/json_values.h"
#include "interaction/step_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::interaction {
namespace {

using nlohmann::json;

constexpr const char* kKeysFormat = "isochron keys";
constexpr std::uint64_t kKeysVersion = 1;
constexpr const char* kHead = "head"; ///< name of the device

/// The keys that hold one thing, with its values.
template <class T>
struct Held {
    KeyTimes times;
    std::vector<T> values;

    /// @return null before anything is held
    const T* value(const KeyPlace& place) const {
        return values.empty() ? nullptr : &values[place.key];
    }
    KeyPlace place(double time) const { return values.empty() ? KeyPlace{} : times.place(time); }
    bool moves(const KeyPlace& place) const { return place.share > 0; }
};

/// @param value of a key; empty: the key does not hold it
template <class T, class Value>
Held<T> held_by(std::span<const KeyFrame> keys, const Value& value) {
    Held<T> held;
    for (const KeyFrame& key : keys)
        if (std::optional<T> one = value(key)) {
            held.times.at.push_back({key.time, key.time + key.hold, key.pace == KeyPace::even});
            held.values.push_back(std::move(*one));
        }
    return held;
}

template <class T, class Part>
KeyedNumber number_of(const Held<T>& held, const Part& part) {
    std::vector<double> values;
    for (const T& value : held.values)
        values.push_back(part(value));
    return {held.times, std::move(values), true};
}

/// Whether the first key is seen again in the last one.
bool is_closed(std::span<const KeyFrame> keys) {
    const KeyFrame &first = keys.front(), &last = keys.back();
    return keys.size() > 2 && first.room_from_physical && last.room_from_physical &&
           *first.room_from_physical == *last.room_from_physical && first.head == last.head;
}

/// Where data and head are.
class KeyedView {
  public:
    KeyedView(std::span<const KeyFrame> keys, const KeyScene& scene)
        : data_(held_by<Similarity>(keys,
                                    [](const KeyFrame& key) { return key.room_from_physical; })),
          heads_(held_by<Pose>(keys, [](const KeyFrame& key) { return key.head; })) {
        data_.times.closed = is_closed(keys);
        heads_.times.closed = data_.times.closed && keys.front().head;
        if (!data_.values.empty())
            motion_.emplace(data_.times, data_.values, scene.pivot);
        if (heads_.values.empty())
            return;
        std::vector<glm::dvec3> places;
        std::vector<glm::dquat> turns;
        for (const Pose& head : heads_.values) {
            places.emplace_back(head.position);
            turns.push_back(glm::normalize(glm::dquat(head.orientation)));
        }
        head_place_.emplace(heads_.times, places);
        head_turn_.emplace(heads_.times, std::move(turns));
    }

    void show(double time, Settings& settings, InputState& input) const {
        if (motion_)
            settings.room_from_physical = motion_->at(data_.place(time));
        if (!head_place_)
            return;
        const KeyPlace place = heads_.place(time);
        const Pose head = heads_.moves(place) ? Pose{glm::vec3(head_place_->at(place)),
                                                     glm::quat(head_turn_->at(place))}
                                              : *heads_.value(place);
        auto found = std::ranges::find(input.devices, kHead, &DeviceState::name);
        if (found == input.devices.end()) {
            found = input.devices.emplace(found);
            found->name = kHead;
        }
        found->pose = head;
    }

  private:
    Held<Similarity> data_;
    Held<Pose> heads_;
    std::optional<KeyedSimilarity> motion_;
    std::optional<KeyedPosition> head_place_;
    std::optional<KeyedTurn> head_turn_;
};

/// The moments of the series.
class KeyedTime {
  public:
    KeyedTime(std::span<const KeyFrame> keys, const StepTimes& times)
        : gaps_(times.gaps), track_(times.at, {}, {}),
          held_(held_by<Instant>(keys, [](const KeyFrame& key) {
              return key.step ? std::optional(Instant(*key.step, key.fraction)) : std::nullopt;
          })) {
        if (!held_.values.empty())
            number_.emplace(
                number_of(held_, [&](const Instant& at) { return track_.time_of(at, false); }));
    }

    void show(double time, Settings& settings) const {
        if (!number_)
            return;
        const KeyPlace place = held_.place(time);
        if (!held_.moves(place)) {
            settings.instant = *held_.value(place);
            return;
        }
        // Where steps are held, too, the nearest fraction counts, so that no step comes a frame late.
        const Instant at = track_.instant_at(number_->at(place), gaps_);
        settings.instant = settings.blends() ? at : Instant(at.step);
    }

  private:
    const StepGaps& gaps_;
    StepTrack track_;
    Held<Instant> held_;
    std::optional<KeyedNumber> number_;
};

/// Isovalues, colors and opacities of surfaces, the planes, and the ghosts.
class KeyedSurfaces {
  public:
    KeyedSurfaces(std::span<const KeyFrame> keys, const KeyScene& scene) {
        Settings settings = scene.start;
        surfaces_ = held_by<std::vector<Isosurface>>(keys, [&](const KeyFrame& key) {
            auto surfaces = surfaces_of(key, settings);
            show_key(key, settings);
            return surfaces;
        });
        clips_ = held_by<ClipPlane>(keys, [](const KeyFrame& key) { return key.clip; });
        slices_ = held_by<Slices>(keys, [](const KeyFrame& key) { return key.slices; });
        ghosts_ = held_by<Ghosts>(keys, [](const KeyFrame& key) { return key.ghosts; });
        const auto& all = surfaces_.values;
        const auto differs = [&](const KeyFrame& key) {
            return key.array && *key.array != keys.front().array.value_or(scene.start.array);
        };
        const auto of_others = [&](const std::vector<Isosurface>& surfaces) {
            return !std::ranges::equal(surfaces, all[0], {}, &Isosurface::array,
                                       &Isosurface::array);
        };
        // Values of other arrays are no values between these.
        if (all.empty() || std::ranges::any_of(keys, differs) ||
            std::ranges::any_of(all, of_others))
            return;
        for (std::size_t i = 0; i < all[0].size(); ++i) {
            const bool positive =
                std::ranges::all_of(all, [&](const auto& s) { return s[i].isovalue > 0; });
            logarithmic_.push_back(scene.logarithmic && positive);
            isovalues_.push_back(number_of(surfaces_, [&](const std::vector<Isosurface>& s) {
                return logarithmic_[i] ? std::log(s[i].isovalue) : s[i].isovalue;
            }));
        }
    }

    void show(double time, Settings& settings) const {
        const KeyPlace place = surfaces_.place(time);
        if (const auto* const surfaces = surfaces_.value(place); surfaces && !isovalues_.empty()) {
            settings.isosurfaces = *surfaces;
            for (std::size_t i = 0; surfaces_.moves(place) && i < isovalues_.size(); ++i)
                settings.isosurfaces[i] =
                    between((*surfaces)[i], surfaces_.values[place.key + 1][i], i, place);
        }
        const KeyPlace clip = clips_.place(time);
        if (clips_.moves(clip))
            settings.clip = between(*clips_.value(clip), clips_.values[clip.key + 1], clip);
        const KeyPlace slices = slices_.place(time);
        if (slices_.moves(slices))
            settings.slices =
                between(*slices_.value(slices), slices_.values[slices.key + 1], slices);
        const KeyPlace ghosts = ghosts_.place(time);
        if (ghosts_.moves(ghosts))
            settings.ghosts =
                between(*ghosts_.value(ghosts), ghosts_.values[ghosts.key + 1], ghosts);
    }

  private:
    static float eased(const KeyPlace& place) {
        return static_cast<float>(place.share * place.share * (3 - 2 * place.share));
    }
    Isosurface between(Isosurface from, const Isosurface& to, std::size_t i,
                       const KeyPlace& place) const {
        if (from.isovalue != to.isovalue) {
            const double at = isovalues_[i].at(place);
            from.isovalue = logarithmic_[i] ? std::exp(at) : at;
        }
        from.color = glm::mix(from.color, to.color, eased(place));
        from.opacity = std::lerp(from.opacity, to.opacity, eased(place));
        return from;
    }
    static void move(auto& plane, const auto& to, double share) {
        const glm::dvec3 normal = glm::mix(plane.normal, to.normal, share);
        constexpr double kOpposite = 1e-3; // the planes face each other: there is no way between
        if (glm::length(normal) < kOpposite)
            return;
        plane.point = glm::mix(plane.point, to.point, share);
        plane.normal = glm::normalize(normal);
    }
    /// Planes that are shown at both keys move between them.
    static ClipPlane between(ClipPlane from, const ClipPlane& to, const KeyPlace& place) {
        if (from.shown && to.shown)
            move(from, to, eased(place));
        return from;
    }
    static Slices between(Slices from, const Slices& to, const KeyPlace& place) {
        for (std::size_t i = 0; i < from.planes.size() && i < to.planes.size(); ++i)
            move(from.planes[i], to.planes[i], eased(place));
        return from;
    }

    /// Those that come fade in, and those that go fade out.
    static Ghosts between(const Ghosts& from, const Ghosts& to, const KeyPlace& place) {
        if (!from.shown() && !to.shown())
            return from;
        Ghosts ghosts = from.shown() ? from : to;
        ghosts.opacity = std::lerp(from.shown() ? from.opacity : 0.0f,
                                   to.shown() ? to.opacity : 0.0f, eased(place));
        return ghosts;
    }

    Held<std::vector<Isosurface>> surfaces_;
    Held<ClipPlane> clips_;
    Held<Slices> slices_;
    Held<Ghosts> ghosts_;
    std::vector<KeyedNumber> isovalues_; ///< for each surface; empty: they change at keys
    std::vector<bool> logarithmic_;
};

} // namespace

std::vector<RecordedFrame> frames_of(std::span<const KeyFrame> keys, const KeyScene& scene) {
    const KeyedView view(keys, scene);
    const KeyedTime instants(keys, scene.times);
    const KeyedSurfaces surfaces(keys, scene);
    const double seconds = seconds_of(keys);
    const auto last = static_cast<std::uint64_t>(std::ceil(seconds * scene.rate - 1e-6));
    std::vector<RecordedFrame> frames;
    Settings shown = scene.start;
    shown.keys.clear(); // the film changes none
    shown.story = 0;
    Settings at_key = shown;
    std::size_t passed = 0;
    for (std::uint64_t i = 0; i <= last; ++i) {
        RecordedFrame& frame = frames.emplace_back();
        const double at = static_cast<double>(i) / scene.rate, time = std::min(at, seconds);
        for (; passed < keys.size() && (passed == 0 || keys[passed].time <= time); ++passed)
            show_key(keys[passed], at_key);
        Settings now = at_key;
        frame.input = scene.seen;
        frame.input.time = Seconds(at);
        view.show(time, now, frame.input);
        surfaces.show(time, now);
        instants.show(time, now);
        now.story = scene.titled ? titled_key(keys, time) : 0;
        frame.commands = changes(shown, now);
        shown = std::move(now);
    }
    return frames;
}

std::string keys_text(std::span<const KeyFrame> keys, const std::string& data) {
    Commands commands;
    commands.keys.emplace(keys.begin(), keys.end());
    json value{{"format", kKeysFormat},
               {"version", kKeysVersion},
               {"keys", commands_json(commands).at("keys")}};
    if (!data.empty())
        value["data"] = data;
    return value.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

std::vector<KeyFrame> keys_from(std::string_view text, const std::string& name, std::string* data) {
    constexpr int kDeepest = 16;
    const auto fail_with = [&](const std::string& what) { throw Error("{}: {}", name, what); };
    json value;
    try {
        value = json::parse(text, [&](int depth, json::parse_event_t, json&) {
            if (depth > kDeepest)
                throw Error("nested deeper than {} levels", kDeepest);
            return true;
        });
    } catch (const json::exception&) {
        fail_with("not a file of keys: no JSON");
    } catch (const Error& mistake) {
        fail_with(mistake.what());
    }
    std::vector<KeyFrame> keys;
    std::string where;
    try {
        const auto format = value.is_object() ? value.find("format") : value.end();
        if (!value.is_object() || format == value.end() || *format != kKeysFormat)
            throw Error("not a file of keys: expected \"format\": \"{}\"", kKeysFormat);
        Members members(value, "keys");
        members.at("format");
        natural(members.at("version"), "version", kKeysVersion);
        double rests = -kShortestMove;
        for (const json& one : list(members.at("keys"), "keys", 1, kMostKeyFrames)) {
            where = fmt::format("key {}: ", keys.size() + 1);
            keys.push_back(commands_from({{"keys", json::array({one})}}, "key").keys->front());
            const KeyFrame& key = keys.back();
            if (key.time < rests + kShortestMove)
                throw Error(
                    "time: expected more than {} s, the end of the rest at the key before, got {}",
                    rests, key.time);
            rests = key.time + key.hold;
            if (rests > kLongestFilm)
                throw Error("hold: expected an end at {} s or before, got {}", kLongestFilm, rests);
        }
        where.clear();
        if (const json* const named = members.find("data")) {
            const std::string index = interaction::text(*named, "data", kLongestArrayName);
            if (data)
                *data = index;
        }
        members.done({"format", "version", "keys", "data"});
    } catch (const Error& mistake) {
        fail_with(where + mistake.what());
    }
    return keys;
}

} // namespace isochron::interaction
