// Undo and redo.
#include "app/frame/history.h"

#include "app/text.h"
#include "interaction/input/actions.h"
#include "interaction/navigation/navigation.h"

#include "interaction/command_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace isochron::app {
namespace {

constexpr interaction::Seconds kPause{0.4}; ///< without a change ends a drag without a button

/// Whether time that plays to and fro has turned, which is nobody's change.
bool turned_by_itself(const ExplorerState& a, const ExplorerState& b) {
    interaction::PlaybackState turned = a.playback;
    turned.reverse = !turned.reverse;
    return a.playback.playing && a.playback.ping_pong && b.playback == turned;
}

/// The settings that differ between two states, one bit each; `dragged` has only the settings that
/// a drag changes. What time does while it plays does not count.
struct Changed {
    std::uint64_t all = 0, dragged = 0;
};

Changed changed(const ExplorerState& a, const ExplorerState& b) {
    Changed result;
    std::uint64_t bit = 1;
    interaction::each_setting(
        [&](const interaction::Field& field, const auto& left, const auto& right) {
            const void* member = &left;
            const bool played = (a.playback.playing && member == &a.instant) ||
                                (member == &a.playback && turned_by_itself(a, b));
            if (field.undone && !played && !(left == right)) {
                result.all |= bit;
                if (field.dragged)
                    result.dragged |= bit;
            }
            bit <<= 1;
        },
        a, b);
    return result;
}

bool holds_something(const interaction::InputState& input) {
    return std::ranges::any_of(input.devices, [](const interaction::DeviceState& device) {
        return device.buttons != 0 || device.actions.any();
    });
}

interaction::Commands way_to(const ExplorerState& target, const ExplorerState& from) {
    interaction::Commands way = from.commands_to(target);
    if (from.playback.playing && target.playback.playing) // undo does not stop time that plays
        way.instant.reset();
    return way;
}

/// What differs between the surfaces of two states.
std::string surface_words(const ExplorerState& before, const ExplorerState& after) {
    const auto &old = before.isosurfaces, &now = after.isosurfaces;
    if (old.size() != now.size())
        return old.size() < now.size() ? "surface added" : "surface removed";
    const auto differs = [&](auto member) {
        return std::ranges::mismatch(old, now, {}, member, member);
    };
    if (const auto at = differs(&interaction::Isosurface::array); at.in1 != old.end())
        return "array of a surface";
    if (const auto at = differs(&interaction::Isosurface::isovalue); at.in1 != old.end())
        return "isovalue " + range_text(at.in1->isovalue, at.in2->isovalue);
    if (const auto at = differs(&interaction::Isosurface::opacity); at.in1 != old.end())
        return fmt::format("opacity {:.0f} to {:.0f} %", 100 * at.in1->opacity,
                           100 * at.in2->opacity);
    return "color of the surface";
}

/// What people call a setting, where that is not its key.
std::string words_of_setting(std::string_view key) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 17> kWords{
        {{"picked", "surface that is chosen"},
         {"coloring", "colors"},
         {"look", "look"},
         {"bounding_box", "box"},
         {"step", "time"},
         {"between", "blending between steps"},
         {"follow", "following the last step"},
         {"playback", "playing"},
         {"play_range", "range that plays"},
         {"keys", "key frames"},
         {"room_from_physical", "view"},
         {"eye_separation", "eyes"},
         {"views", "viewpoints"},
         {"clip", "clip plane"},
         {"clip_box", "clip box"},
         {"tools", "tool"},
         {"orthographic", "projection"}}};
    const auto* const row =
        std::ranges::find(kWords, key, &std::pair<std::string_view, std::string_view>::first);
    return std::string(row == kWords.end() ? key : row->second);
}

} // namespace

std::string words_for_change(const ExplorerState& before, const ExplorerState& after) {
    constexpr std::size_t kSaid = 3;
    std::vector<std::string> words;
    interaction::each_setting(
        [&](const interaction::Field& field, const auto& left, const auto& right) {
            if (!field.undone || left == right)
                return;
            const bool surfaces = static_cast<const void*>(&left) == &before.isosurfaces;
            words.push_back(surfaces ? surface_words(before, after) : words_of_setting(field.key));
        },
        before, after);
    return words.size() > kSaid ? fmt::format("{} settings", words.size())
                                : fmt::format("{}", fmt::join(words, ", "));
}

std::string words_for_way(const ExplorerState& now, const interaction::Commands* way,
                          std::size_t held) {
    ExplorerState then = now;
    if (way)
        then.apply(*way, held);
    return words_for_change(now, then);
}

bool History::continues(std::uint64_t fields, const interaction::InputState& input) const {
    // A film's preview moves the view in each frame, and steps in some.
    return !past_.empty() && fields != 0 && (fields & ~fields_) == 0 &&
           (held_ || input.time - changed_ <= kPause);
}

void History::add_change(const ExplorerState& before, const ExplorerState& after,
                         const interaction::InputState& input) {
    const Changed what = changed(before, after);
    if (what.all == 0)
        return;
    const std::uint64_t fields = what.all == what.dragged ? what.all : 0;
    if (!continues(fields, input)) {
        past_.push_back(before);
        if (past_.size() > kMost)
            past_.pop_front();
        fields_ = fields;
    }
    changed_ = input.time;
    held_ = true;
    future_.clear();
}

/// The state to go back to: what the user saw. If a key has reset the emulated head as well, the
/// data are moved along with it, so that undo puts them at the same place relative to the head.
ExplorerState History::as_seen(ExplorerState before, const interaction::InputState& input) const {
    const interaction::DeviceState* head = input.find("head");
    const interaction::DeviceState* keys = input.find("keys");
    const bool emulated = input.find("pointer") != nullptr;
    if (emulated && head_ && head && head->pose && keys &&
        holds(keys->actions, interaction::Action::reset))
        before.room_from_physical =
            interaction::carried(before.room_from_physical, *head_, *head->pose);
    return before;
}

/// What a step of a story sets is nobody's change: all states have it, so that undo does not undo it.
void History::adopt(const ExplorerState& before, const ExplorerState& after) {
    const auto adopt_into = [&](ExplorerState& state) {
        interaction::each_setting(
            [](const interaction::Field& field, auto& kept, const auto& old, const auto& now) {
                if (field.undone && !(old == now))
                    kept = now;
            },
            state, before, after);
        state.picked =
            std::min(state.picked, static_cast<std::uint32_t>(state.isosurfaces.size() - 1));
    };
    std::ranges::for_each(past_, adopt_into);
    std::ranges::for_each(future_, adopt_into);
    fields_ = 0;
}

void History::add(const ExplorerState& earlier, const ExplorerState& after,
                  const interaction::Commands& commands, const interaction::InputState& input) {
    const ExplorerState before = as_seen(earlier, input);
    if (const interaction::DeviceState* head = input.find("head"))
        head_ = head->pose;
    if (commands.undo && !past_.empty()) {
        future_.push_back(before);
        past_.pop_back();
        fields_ = 0;
    } else if (commands.redo && !future_.empty()) {
        past_.push_back(before);
        future_.pop_back();
        fields_ = 0;
    } else if (commands.story) {
        adopt(before, after);
    } else {
        add_change(before, after, input);
    }
    held_ = held_ && holds_something(input);
    if (before == after && !commands.undo && !commands.redo)
        return;
    undo_.reset();
    redo_.reset();
    if (!past_.empty()) {
        undo_ = way_to(past_.back(), after);
        undo_->undo = true;
    }
    if (!future_.empty()) {
        redo_ = way_to(future_.back(), after);
        redo_->redo = true;
    }
}

} // namespace isochron::app
