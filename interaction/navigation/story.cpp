// Stories: the key frames that have texts.
#include "interaction/navigation/story.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::interaction {

std::string name_of_key(std::span<const KeyFrame> keys, std::size_t number) {
    return keys[number].name.empty() ? fmt::format("key {}", number + 1) : keys[number].name;
}

std::string title_of_key(const KeyFrame& key) {
    return fmt::format("{}{}{}", key.name, key.name.empty() || key.text.empty() ? "" : "\n",
                       key.text);
}

bool has_titles(std::span<const KeyFrame> keys) {
    return std::ranges::any_of(keys,
                               [](const KeyFrame& key) { return !title_of_key(key).empty(); });
}

std::uint32_t titled_key(std::span<const KeyFrame> keys, double time) {
    constexpr double kLeast = 2; // [s] for a title to be read
    for (std::size_t i = keys.size(); i-- > 0;)
        if (keys[i].time <= time)
            return time <= keys[i].time + std::max(keys[i].hold, kLeast) &&
                           !title_of_key(keys[i]).empty()
                       ? static_cast<std::uint32_t>(i) + 1
                       : 0;
    return 0;
}

const KeyFrame* told_key(const Settings& settings) {
    if (settings.story == 0 || settings.story > settings.keys.size())
        return nullptr;
    const KeyFrame& key = settings.keys[settings.story - 1];
    return key.text.empty() ? nullptr : &key;
}

StoryStep story_step(std::span<const KeyFrame> keys, std::uint32_t told) {
    StoryStep step;
    for (std::uint32_t i = 1; i <= keys.size(); ++i) {
        if (keys[i - 1].text.empty())
            continue;
        ++step.of;
        if (i <= told)
            step.number = step.of;
        if (i < told)
            step.previous = i;
        if (i > told && step.next == 0)
            step.next = i;
    }
    return step;
}

std::string story_heading(std::span<const KeyFrame> keys, std::uint32_t told) {
    const StoryStep step = story_step(keys, told);
    const std::string& name = keys[told - 1].name;
    return fmt::format("{} of {}{}{}", step.number, step.of, name.empty() ? "" : ": ", name);
}

} // namespace isochron::interaction
