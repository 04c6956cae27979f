// A check of a configuration: a row of a table, which says what the check is about and how it looks.
#pragma once

#include "app/config/check/checked_room.h"

#include <fmt/core.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

class Tell;

struct Check {
    enum Severity : bool { odd, wrong }; ///< a warning, as it may be intended; an error
    const char* key;                     ///< `*` stands for the key of a tracker
    Severity severity;
    void (*look)(const CheckedRoom& room, const Tell& tell);
};

/// Tells what a check has found in a room, under the check's key. What has been told already is left
/// out.
class Tell {
  public:
    Tell(const Check& check, const CheckedRoom& room, std::vector<ConfigProblem>& found)
        : check_(check), room_(room), found_(found) {}
    /// Tells of a tracker. @param key of the tracker
    Tell of(const std::string& key) const {
        Tell of_tracker = *this;
        of_tracker.tracker_ = key;
        return of_tracker;
    }
    /// @param line of the file; 0: the line of the check's key, if the file has it
    /// @param text a format with its values
    template <class... Values>
    void operator()(int line, fmt::format_string<Values...> text, Values&&... values) const {
        add(line, fmt::format(text, std::forward<Values>(values)...));
    }

  private:
    void add(int line, const std::string& text) const;

    const Check& check_;
    const CheckedRoom& room_;
    std::vector<ConfigProblem>& found_;
    std::string tracker_;
};

// The checks of each topic. A further check is a function and its row in one of these.
std::span<const Check> checks_of_screens();
std::span<const Check> checks_of_walls();    ///< how the screens of a room stand to one another
std::span<const Check> checks_of_displays(); ///< how displays share windows, desktops and planes
std::span<const Check> checks_of_viewers();
std::span<const Check> checks_of_devices();
std::span<const Check> checks_of_values(); ///< numbers that are unlikely to be meant

/// What some checks find, in their order.
std::vector<ConfigProblem> findings_of(std::span<const Check> checks, const CheckedRoom& room);

} // namespace isochron::app
