// The controls of a film's key frames.
#include "interaction/controls/key_frame_controls.h"

#include "interaction/navigation/key_frames.h"

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

std::string words_of_key(std::span<const KeyFrame> keys, std::size_t number) {
    return fmt::format("key {} of {}, at {:.4g} s of the film", number + 1, keys.size(),
                       keys[number].time);
}

void add_seen(const Settings& now, const Pose& viewer, Commands& commands,
              std::vector<std::string>& notes) {
    Settings seen = now;
    seen.room_from_physical = commands.room_from_physical.value_or(seen.room_from_physical);
    auto keys = with_key(now.keys, key_of(seen, viewer));
    if (keys.size() == now.keys.size()) {
        notes.push_back(fmt::format("there is no room for a further key: a film has at most {} "
                                    "keys and {} s",
                                    kMostKeyFrames, kLongestFilm));
        return;
    }
    notes.push_back(words_of_key(keys, keys.size() - 1) +
                    (keys.size() == 1 ? ": a film needs one more" : ""));
    commands.keys = std::move(keys);
}

} // namespace

void press_key_frames(Action action, const Settings& now, const Pose& viewer, Commands& commands,
                      std::vector<std::string>& notes) {
    if (action == Action::add_key)
        return add_seen(now, viewer, commands, notes);
    if (now.keys.empty()) {
        notes.emplace_back("the film has no keys: Ctrl + M makes what is seen one");
        return;
    }
    const std::size_t count = now.keys.size();
    const auto seen = seen_key(now, viewer);
    if (action == Action::remove_key) {
        const std::size_t number = seen.value_or(count - 1);
        commands.keys = without_key(now.keys, number);
        notes.push_back(fmt::format("key {} is removed: Ctrl + Z brings it back", number + 1));
        return;
    }
    const std::size_t number = action == Action::next_key ? (seen ? (*seen + 1) % count : 0)
                                                          : (seen.value_or(0) + count - 1) % count;
    merge(commands, way_to_key(now.keys[number], now, viewer));
    notes.push_back(words_of_key(now.keys, number));
}

} // namespace isochron::interaction
