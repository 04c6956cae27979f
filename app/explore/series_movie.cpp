// A movie of an index without a recording.
#include "app/explore/series_movie.h"

#include "app/command_line/command_line.h"
#include "app/command_line/step_range.h"
#include "app/config/first_placement.h"
#include "app/explore/explore_start.h"
#include "app/explore/story_file.h"
#include "app/loop/key_film.h"
#include "app/loop/movie_maker.h"
#include "app/loop/replay.h"
#include "app/version.h"
#include "index/error.h"
#include "index/system/input_file.h"
#include "interaction/error.h"
#include "interaction/navigation/story.h"
#include "interaction/recording/key_film.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

namespace isochron::app {
namespace {

/// Sets what plays: `0:63:4` is every fourth step from 0 to 63.
void play_steps(const SeriesMovie& movie, std::size_t steps, interaction::Commands& state) {
    if (!movie.steps)
        return;
    const std::vector<std::uint32_t> chosen = steps_of(*movie.steps, "--steps", steps);
    state.play_range = interaction::StepRange{chosen.front(), chosen.back()};
    interaction::PlaybackState playback = state.playback.value_or(interaction::PlaybackState{});
    playback.every = chosen.size() > 1 ? chosen[1] - chosen[0] : 1;
    if (playback.every > interaction::kMostSkipped)
        throw UsageError("--steps: a movie takes every {}th step at most, got {}",
                         interaction::kMostSkipped, *movie.steps);
    state.playback = playback;
}

std::vector<interaction::KeyFrame> keys_of(const std::string& path) {
    constexpr std::uint64_t kLargest = 1 << 22; ///< [byte]
    return keys_in(index::read_text(path, kLargest), path);
}

std::vector<interaction::KeyFrame> turn(const Session& session, const index::SeriesInfo& info,
                                        const SeriesMovie& movie) {
    const auto steps = steps_or_all(movie.steps, "--steps", info.steps());
    if (steps.size() > 1 && steps[1] != steps[0] + 1)
        throw UsageError("--turn: all steps pass, expected --steps FIRST:LAST, got {}",
                         *movie.steps);
    return interaction::turn_keys(
        session.state(), physical_center(info.grid), index::Instant(steps.front()),
        index::Instant(movie.film == "turn" ? steps.front() : steps.back()),
        movie.length.value_or(kUsualTurn));
}

} // namespace

void expect_fit(const std::vector<interaction::KeyFrame>& keys, const std::string& path,
                const Session& session, std::size_t steps) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const interaction::Commands shown = interaction::way_to_key(keys[i], session.state(), {});
        std::vector<std::string> refused = session.state().refusals(shown, steps);
        if (shown.array)
            try {
                session.expect_array(*shown.array);
            } catch (const index::Error& error) {
                refused.emplace_back(error.what());
            }
        if (!refused.empty())
            throw interaction::Error("{}: key {} does not fit the data: {}", path, i + 1,
                                     fmt::join(refused, "; "));
    }
}

void fill_picture(const Session& session, const Config& config, const index::SeriesInfo& info,
                  ExplorerState& state) {
    const stereo::Windows& windows = session.outputs().windows();
    const stereo::Screen& screen = config.installation.windows.front().viewports.front().screen;
    if (config.placement.fill <= 0 || windows.room() || !screen.carried_by_head ||
        !screen.fit_aspect)
        return;
    state.room_from_physical = filling(info, config.placement, screen,
                                       {config.installation.viewers.front().position, {1, 0, 0, 0}},
                                       windows.first().framebuffer_size());
}

interaction::RecordingHeader header_of_series(const ReplaySource& options) {
    interaction::RecordingHeader header;
    header.program = kProgram;
    header.configuration = read_config(options.config.value_or("desktop")).text;
    header.data = std::filesystem::absolute(options.recording).string();
    return header;
}

interaction::Recording steps_seen(Session& session, const Config& config,
                                  const index::IndexFile& file,
                                  const interaction::RecordingHeader& header,
                                  const SeriesMovie& movie, double rate) {
    const index::SeriesInfo& info = file.info();
    ExplorerState start = session.state();
    fill_picture(session, config, info, start);
    const std::size_t array = first_array(file);
    if (array > 0)
        start.apply(session.way_to_array(array), info.steps());
    if (movie.isovalue)
        start.set_isovalue(*movie.isovalue);
    if (movie.between)
        start.between = *interaction::value_named<interaction::BetweenSteps>(*movie.between);
    else if (!config.between)
        start.between = advised_between(file.array(array));
    session.set_state(start);
    interaction::Recording recording;
    if (movie.turns() || !movie.keys.empty()) {
        const auto keys = movie.turns() ? turn(session, info, movie) : keys_of(movie.keys);
        expect_fit(keys, movie.keys, session, info.steps());
        constexpr double kMostFrames = 1 << 20;
        if (const double frames = interaction::seconds_of(keys) * rate; frames > kMostFrames)
            throw UsageError("--rate: a film has at most {:.0f} frames, got {:.4g}", kMostFrames,
                             frames);
        if (movie.titles && !interaction::has_titles(keys))
            throw interaction::Error(
                "{}: --titles: expected a key with a \"name\" or a \"text\", there is none",
                movie.keys);
        recording = film_of_keys(session, header, keys, rate, movie.titles);
    } else {
        PictureNote view = session.note();
        play_steps(movie, info.steps(), view.state);
        recording = series_seen(header, view, session.times(), rate);
    }
    session.set_state(start_of(recording.header, session.state(), info.steps(), {}));
    return recording;
}

} // namespace isochron::app
