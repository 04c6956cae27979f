// Lists fields.
#include "index/readers/formats/unread_fields.h"

#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace isochron::index {

std::optional<std::string> note_on_unread(const std::vector<std::string>& fields) {
    constexpr std::ptrdiff_t kShown = 12;
    if (fields.empty())
        return std::nullopt;
    const auto shown = std::min(std::ssize(fields), kShown);
    std::string note = fmt::format("stated and not used: {}",
                                   fmt::join(fields.begin(), fields.begin() + shown, ", "));
    if (shown < std::ssize(fields))
        note += fmt::format(" and {} more", std::ssize(fields) - shown);
    return note;
}

std::vector<std::string> fields_besides(const std::set<std::string_view>& keys,
                                        const std::map<std::string, std::string>& fields) {
    std::vector<std::string> others;
    for (const auto& [key, value] : fields)
        if (!keys.contains(key))
            others.push_back(fmt::format("{} {}", key, excerpt(value)));
    return others;
}

} // namespace isochron::index
