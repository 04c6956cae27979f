// Finds out in the background whether data that the user has chosen can be opened.
#pragma once

#include "interaction/input/window_event.h"

#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

class DataOpening {
  public:
    /// Returns in one line why data cannot be opened; empty: they can. Called on a thread of its own.
    using WhyNot = std::function<std::string(const std::filesystem::path&)>;

    /// @param why_not null: other data are not opened
    explicit DataOpening(WhyNot why_not) : why_not_(std::move(why_not)) {}

    /// Begins with these data, or with them next: what was chosen last counts.
    /// @return what the user is told; empty: nothing
    std::string open(const std::filesystem::path& data);
    /// Once a frame; never waits. @return what the user is told; empty: nothing
    std::string update();
    /// Gives up what goes on if Escape is pressed, which does nothing else then.
    /// @return what the user is told; empty: nothing
    std::string cancel_on_escape(std::vector<interaction::WindowEvent>& events);

    bool busy() const { return opening_.has_value(); }
    /// What goes on, for the user; empty: nothing.
    std::string note() const;
    /// The data that can be opened; returned once.
    std::optional<std::filesystem::path> take_ready() { return std::exchange(ready_, {}); }

  private:
    struct Opening {
        std::filesystem::path data;
        std::future<std::string> why_not;
    };

    const WhyNot why_not_;
    std::optional<Opening> opening_;
    std::optional<std::filesystem::path> next_; ///< chosen while others are being opened
    std::optional<std::filesystem::path> ready_;
    std::vector<std::future<std::string>> given_up_; ///< whose answer nobody wants any more
};

} // namespace isochron::app
