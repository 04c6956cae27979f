// What happens before a session's first picture: the window says what is being done, and Escape
// gives it up.
#pragma once

#include "app/config/config.h"
#include "app/loop/data_window.h"
#include "app/loop/page_window.h"
#include "index/file/index_file.h"
#include "interaction/input/window_event.h"
#include "stereo/windows.h"

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace isochron::app {

/// Opens an index on a thread of its own, so that a slow disk holds up no window. Who gives up lets
/// that thread end alone.
class IndexOpening {
  public:
    using File = std::shared_ptr<const index::IndexFile>;
    explicit IndexOpening(std::function<File()> open);

    /// Waits until it is done, at most this long. @return whether it is done
    bool is_done(std::chrono::milliseconds most = std::chrono::milliseconds(0)) const;
    /// Waits for the index. @throws what opening throws
    File take() { return file_.get(); }

  private:
    std::future<File> file_;
};

/// Options of a page that is shown before there is a session.
PageWindowOptions page_options(const Config& config);

/// Says in the first window what is being done, until it is done.
/// @param name of the data @param line `opening`, for example
Waited wait_until(const std::function<bool()>& done, const stereo::Windows& windows,
                  const std::string& name, const std::string& line, const Config& config);

/// Says in every window that the data are being loaded.
/// @param others gets the events of these windows
/// @param but_first leaves the first one out, as a page of its own comes there at once
void show_loading(const stereo::Windows& windows, const std::string& name, const Config& config,
                  std::vector<interaction::WindowEvent>& others, bool but_first);

/// Says in the first window that data are being prepared, on the thread that prepares them: between
/// two parts of the work it looks at the windows.
class PreparingPage {
  public:
    /// Shows the page. @param windows outlive it
    /// @param others gets the events that have another meaning; outlives it
    PreparingPage(const stereo::Windows& windows, std::string name, const Config& config,
                  std::vector<interaction::WindowEvent>& others);

    /// Sees what the user has done, and shows the page again where the window has lost it or more
    /// of the work is done. The context that draws is current afterwards.
    /// @param share of the work that is done
    /// @return whether to go on: false once the user has pressed Escape or closed the window
    bool look(float share);
    /// The user has pressed Escape.
    bool canceled() const { return canceled_; }

  private:
    const stereo::Windows& windows_;
    const std::string name_;
    PageWindow page_;
    bool canceled_ = false, left_ = false;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

/// `, about 3 s`: what is left of work that goes on as it did so far; empty as long as nobody knows.
std::string time_left(float share, interaction::Seconds elapsed);

} // namespace isochron::app
