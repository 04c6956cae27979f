// Takes other data that the user has chosen, and finds out in the background whether they can be opened.
#pragma once

#include "app/session/session.h"
#include "interaction/input/window_event.h"

#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// What the user wants to see next.
struct NextData {
    std::filesystem::path data;
    std::string array = {}; ///< array of the present files, instead of `data`; empty: other data
};

class DataOpening {
  public:
    /// Returns in one line why data cannot be opened; empty: they can. Called on a thread of its own.
    using WhyNot = std::function<std::string(const std::filesystem::path&)>;

    /// @param why_not null: other data are not opened
    explicit DataOpening(WhyNot why_not) : why_not_(std::move(why_not)) {}

    /// Takes other data that the user has chosen, or dropped onto a window: what was chosen last
    /// counts. Once a frame; never waits.
    /// @param why_stay why the data cannot give way to others now; empty: they can
    void update(Session& session, const std::string& why_stay);
    /// Gives up what goes on if Escape is pressed, which does nothing else then.
    void cancel_on_escape(Session& session, std::vector<interaction::WindowEvent>& events);

    bool busy() const { return opening_.has_value(); }
    /// What goes on, for the user; empty: nothing.
    std::string note() const;
    /// Other data, which can be opened; empty: none.
    const std::optional<NextData>& next_data() const { return next_data_; }

  private:
    struct Opening {
        std::filesystem::path data;
        std::future<std::string> why_not;
    };

    std::string begin(const std::filesystem::path& data);
    std::string look();

    const WhyNot why_not_;
    std::optional<Opening> opening_;
    std::optional<std::filesystem::path> next_; ///< chosen while others are being opened
    std::optional<NextData> next_data_;
    std::vector<std::future<std::string>> given_up_; ///< whose answer nobody wants any more
};

} // namespace isochron::app
