// A list of things with names: the user goes to one, renames one, removes one.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace isochron::app {

struct NamedRow {
    std::string name;
    std::string note;  ///< beside the name, such as a time
    bool here = false; ///< it is what is shown now
};

/// What the user did with the list in a frame.
struct NamedChange {
    std::optional<std::size_t> chosen, removed;
    std::optional<std::pair<std::size_t, std::string>> renamed;
};

/// Lays the list out in the current window, a line for each. @param go the tip of the button that
/// goes there @param draw draws a small picture of a row around a place; may be null
NamedChange named_list(std::span<const NamedRow> rows, const char* go,
                       const std::function<void(std::size_t row, const ImVec2& middle)>& draw = {});

} // namespace isochron::app
