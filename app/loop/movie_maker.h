// Movies and figures that the panel asks for: a process of their own makes them, so that no frame waits.
#pragma once

#include "app/frame/background_work.h"
#include "app/output/picture_note.h"
#include "app/panel/panel_model.h"
#include "interaction/recording/recording.h"
#include "interaction/step_gaps.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace isochron::app {

inline constexpr const char* kStoryEnding = ".isochron-story"; ///< ending of a story's file

/// What all movies of a session have in common.
struct MovieOrders {
    std::filesystem::path program;       ///< the program that has the command `movie`
    std::filesystem::path folder;        ///< where movies go
    std::vector<std::string> options;    ///< options of that command
    interaction::RecordingHeader header; ///< header of the session
};

/// How one of them is made.
struct MovieManner {
    std::filesystem::path folder = {};    ///< empty: the one of the orders
    double rate = 30.0;                   ///< pictures a second
    std::uint32_t width = 0, height = 0;  ///< [pixel], 0: as it was seen
    bool titles = false;                  ///< titles stand over it
    std::vector<std::string> models = {}; ///< files that the user has let be opened
    bool figure = false; ///< it is a figure: nothing of the above but the folder counts
};

/// Makes one movie at a time: `isochron_movie_0001.mp4` and so on. The recording that it is made of
/// lies beside it. If the movie is canceled or fails, both are deleted. A figure in the same way:
/// `isochron_figure_0001.pdf`, of a description `isochron_figure_0001.toml`.
class MovieMaker {
  public:
    /// Writes the recording, or the description of the figure, under that name; throws if it cannot.
    using Write = std::function<void(const std::filesystem::path&)>;

    explicit MovieMaker(MovieOrders orders);
    ~MovieMaker(); ///< as `finish`
    MovieMaker(const MovieMaker&) = delete;
    MovieMaker& operator=(const MovieMaker&) = delete;

    const MovieOrders& orders() const { return orders_; }

    /// Begins one, unless one is being made. @param write runs on another thread
    void make(const Write& write, BackgroundWork& writing, const MovieManner& manner = {});
    void give_up();
    /// Cancels an unfinished movie, and waits until its files are deleted.
    void finish();
    /// Once a frame; never waits.
    void update();

    bool busy() const { return written_.valid() || process_ > 0; }
    /// How much of the movie is finished, 0 to 1.
    std::optional<float> progress() const;
    /// Name, length and size of the movie that is being made, and how much time is left.
    std::string words() const;
    /// One line for each movie that ended since the last call: its name, or the error.
    std::vector<std::string> messages();

  private:
    std::vector<std::string> command() const;
    void start();
    void read_words();
    void end(int status);

    const MovieOrders orders_;
    std::filesystem::path movie_, recording_; ///< files of the movie that is being made
    std::future<void> written_;               ///< its recording
    bool given_up_ = false;
    MovieManner manner_; ///< manner of the movie that is being made
    pid_t process_ = -1;
    int words_ = -1;    ///< the end of the pipe from the process
    std::string said_;  ///< an incomplete line from the process
    std::string last_;  ///< the newest line that does not report progress
    std::string error_; ///< the newest one that begins with the program's name
    float progress_ = 0;
    std::chrono::steady_clock::time_point began_; ///< its process
    std::vector<std::string> messages_;
};

/// The first name of a recording that no file in a folder has yet: `isochron_recording_0001.jsonl`.
std::filesystem::path free_recording_name(const std::filesystem::path& folder);
/// The first name `isochron_KIND_0001` that no file in a folder has with any of these endings.
/// @return without an ending
std::filesystem::path free_name(const std::filesystem::path& folder, std::string_view kind,
                                std::initializer_list<const char*> endings);

/// The header with the size that the user has chosen for movies, if they have.
interaction::RecordingHeader sized(interaction::RecordingHeader header,
                                   const interaction::WrittenPictures& pictures);

/// The header of a recording that nobody steers: what is seen, in the best quality, with nothing
/// over it. @param view what is seen, see `Session::note`
interaction::RecordingHeader header_of_view(interaction::RecordingHeader header,
                                            const PictureNote& view);
/// The devices of a view where they were, with nothing pressed.
interaction::InputState devices_of_view(const PictureNote& view);

/// A recording in which all steps pass once, as fast as playback would show them, seen from one
/// place in the best quality.
/// @param header of the session
/// @param view what is seen, see `Session::note`
/// @param times of the steps
/// @param rate frames per second: each step is shown for at least one
interaction::Recording series_seen(interaction::RecordingHeader header, const PictureNote& view,
                                   const interaction::StepTimes& times, double rate);

} // namespace isochron::app
