// Lists fields.
#include "index/readers/formats/unread_fields.h"

#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace isochron::index {
namespace {

/// Names and descriptions of data, programs that wrote them, and how others show them: places, times and
/// values are what they are without these fields, which nearly every file of some programs has.
constexpr std::array<std::string_view, 14> kSkipped{
    "aux_file none", "cal_max",   "cal_min",
    "Color",         "Comment",   "content",
    "descrip",       "Grid Name", "ITK_InputFilterName",
    "LABEL",         "max",       "measurement frame (1,0,0) (0,1,0) (0,0,1)",
    "min",           "Name"};

bool is_skipped(std::string_view field) {
    return std::ranges::any_of(kSkipped, [&](std::string_view key) {
        return field.starts_with(key) && (field.size() == key.size() || field[key.size()] == ' ');
    });
}

} // namespace

std::optional<std::string> note_on_unread(const std::vector<std::string>& all) {
    constexpr std::ptrdiff_t kShown = 12;
    std::vector<std::string> fields;
    std::ranges::remove_copy_if(all, std::back_inserter(fields), is_skipped);
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
