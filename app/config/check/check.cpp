// Runs the checks of a configuration.
#include "app/config/check/check.h"

#include <algorithm>

namespace isochron::app {

void Tell::add(int line, const std::string& text) const {
    std::string key = check_.key;
    if (key.starts_with('*'))
        key.replace(0, 1, tracker_);
    if (line == 0)
        line = room_.line_of(key);
    const auto told = [&](const ConfigProblem& known) {
        return known.line == line && known.key == key && known.text == text;
    };
    if (std::ranges::none_of(found_, told))
        found_.push_back({line, key, text, check_.severity == Check::wrong});
}

std::vector<ConfigProblem> findings_of(std::span<const Check> checks, const CheckedRoom& room) {
    std::vector<ConfigProblem> found;
    for (const Check& check : checks)
        check.look(room, Tell(check, room, found));
    return found;
}

} // namespace isochron::app
