// The movies and recordings that the panel asks for, and the folder of pictures that it chooses.
#include "app/loop/panel_movies.h"

#include "app/config/first_placement.h"
#include "app/loop/key_film.h"
#include "app/loop/seen_figure.h"
#include "app/text.h"
#include "index/error.h"
#include "index/system/links/link.h"
#include "index/system/new_file.h"
#include "interaction/error.h"
#include "interaction/input/device_reading.h"
#include "interaction/navigation/key_frames.h"
#include "interaction/recording/key_film.h"
#include "interaction/step_track.h"

#include <glm/common.hpp>

#include <utility>

namespace isochron::app {
namespace {

/// The keys of the film that is wanted; none: it is no film of keys.
std::vector<interaction::KeyFrame> keys_of_wish(const std::optional<MovieWish>& wish,
                                                const Session& session) {
    const ExplorerState& state = session.state();
    if (wish == MovieWish::keys || wish == MovieWish::titled)
        return state.keys;
    if (wish == MovieWish::views && state.views.size() > 1)
        return interaction::view_keys(state.views, physical_center(session.file()->info().grid));
    if (wish != MovieWish::turn && wish != MovieWish::both)
        return {};
    constexpr double kTurn = 10; // [s]
    const auto steps = static_cast<std::uint32_t>(session.times().at.size());
    const bool stands = wish == MovieWish::turn;
    const index::Instant now = state.shown_instant();
    return interaction::turn_keys(state, physical_center(session.file()->info().grid),
                                  stands ? now : index::Instant(first_of(state.play_range, steps)),
                                  stands ? now : index::Instant(last_of(state.play_range, steps)),
                                  kTurn);
}

} // namespace

PanelMovies::PanelMovies(MovieOrders orders, std::shared_ptr<LiveRecording> recording)
    : recording_(std::move(recording)), movies_(std::move(orders)) {}

/// The panel's button: a recording from now on, in the folder of the movies; or the end of the one
/// that goes on.
void PanelMovies::begin_or_end_recording(Session& session) {
    if (recording_->is_open()) {
        recording_->end();
    } else {
        try {
            interaction::RecordingHeader header = movies_.orders().header;
            header.start = interaction::kept_state(session.state().as_commands());
            const auto path = free_recording_name(chosen_folder(session));
            recording_->begin(path, header);
            session.show_messages({"recording to " + whole_path(path)});
        } catch (const interaction::Error& error) {
            session.show_messages({error.what()});
        }
    }
    session.set_recording(recording_->is_open());
}

/// A figure of what is seen, in the background.
void PanelMovies::make_figure(const Session& session, MovieManner manner) {
    const PictureNote seen = session.note();
    interaction::KeyFrame key =
        interaction::key_of(session.state(), interaction::Reading(seen.input).viewer());
    const glm::ivec2 window = session.outputs().windows().first().framebuffer_size();
    const stereo::Margins panel = session.panel().covered(window, rows_of(session.state()));
    const glm::dvec2 size =
        glm::max(window - glm::ivec2(panel.left, panel.top + panel.bottom), glm::ivec2(1));
    manner.figure = true;
    const std::string& index = session.file()->name();
    movies_.make(
        [text = figure_text(index::is_link(index) ? index : whole_path(index), key,
                            size.y / size.x)](const auto& path) { index::write_file(path, text); },
        recording_->work(), manner);
}

/// The keys as a story, beside the data, whose name it says; of data behind an address in the folder of
/// movies.
void PanelMovies::save_story(Session& session) {
    const std::string& data = session.file()->name();
    const bool linked = index::is_link(data);
    std::vector<interaction::KeyFrame> keys = session.state().keys;
    for (interaction::KeyFrame& key : keys)
        key.models.reset(); // a story opens no other files
    try {
        const std::filesystem::path path =
            free_name(linked ? chosen_folder(session)
                             : std::filesystem::path(whole_path(data)).parent_path(),
                      "story", {kStoryEnding})
                .string() +
            kStoryEnding;
        const std::string text = interaction::keys_text(
            keys, linked ? data : std::filesystem::path(data).filename().string());
        index::write_file(path, text);
        session.show_messages({"story saved: " + whole_path(path)});
    } catch (const index::Error& error) {
        session.show_messages({error.what()});
    }
}

/// Where pictures, movies and recordings are written.
std::filesystem::path PanelMovies::chosen_folder(const Session& session) const {
    const std::filesystem::path chosen = session.state().pictures.folder;
    return chosen.empty() ? movies_.orders().folder : chosen;
}

/// Pictures lie where the user has said last.
void PanelMovies::place_pictures(Session& session) {
    if (session.state().pictures.folder == picture_folder_)
        return;
    picture_folder_ = session.state().pictures.folder;
    try {
        index::make_folder(chosen_folder(session));
        session.outputs().set_screenshots(chosen_folder(session));
    } catch (const index::Error& error) {
        session.show_messages({error.what()});
    }
}

/// Begins and ends what the panel asks for.
void PanelMovies::after_frame(Session& session, const LiveFrame&) {
    place_pictures(session);
    const interaction::WrittenPictures& how = session.state().pictures;
    const std::optional<MovieWish> wish = session.panel().take_wanted_movie();
    const MovieManner manner{.folder = how.folder,
                             .rate = how.rate,
                             .width = how.width,
                             .height = how.height,
                             .titles = wish == MovieWish::titled,
                             .models = session.models().allowed(session.state())};
    if (wish == MovieWish::record)
        begin_or_end_recording(session);
    else if (wish == MovieWish::give_up)
        movies_.give_up();
    else if (wish == MovieWish::story)
        save_story(session);
    else if (wish == MovieWish::figure)
        make_figure(session, manner);
    else if (wish == MovieWish::recording && recording_->is_open())
        movies_.make(recording_->copy(), recording_->work(), manner);
    else if (wish == MovieWish::series)
        movies_.make([series = series_seen(sized(movies_.orders().header, how), session.note(),
                                           session.times(), how.rate)](
                         const auto& path) { write_recording(path, series); },
                     recording_->work(), manner);
    else if (const auto keys = keys_of_wish(wish, session); !keys.empty())
        movies_.make(
            [film = film_of_keys(session, sized(movies_.orders().header, how), keys, how.rate,
                                 manner.titles)](const auto& path) { write_recording(path, film); },
            recording_->work(), manner);
    movies_.update();
    session.set_movies({true, recording_->is_open(), movies_.progress(),
                        movies_.busy() ? movies_.words() : whole_path(chosen_folder(session))});
}

std::string PanelMovies::why_stay() const {
    return movies_.busy()
               ? "a movie is being made: open other data when it is finished, or cancel it"
               : "";
}

} // namespace isochron::app
