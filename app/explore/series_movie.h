// A movie of an index without a recording: every step once, as a first look shows them.
#pragma once

#include "app/config/config.h"
#include "app/explore/replay_source.h"
#include "app/session/session.h"
#include "interaction/recording/recording.h"

#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

inline constexpr double kUsualTurn = 10; ///< length of a turn [s]

struct SeriesMovie {
    std::optional<double> isovalue;     ///< none: as at the first look
    std::optional<std::string> steps;   ///< FIRST:LAST[:STRIDE]; none: all
    std::optional<std::string> between; ///< a name of BetweenSteps; none: as configured or advised
    std::string keys{};                 ///< file of keys, or session that has them; empty: none
    bool titles = false;                ///< names and texts of the keys stand over the film
    bool turn = false;                  ///< one turn about the data's up axis, while the steps pass
    std::string film{};                 ///< `time`, `turn`, `both`; empty: as `turn` says
    std::optional<double> length;       ///< seconds of the turn; empty: kUsualTurn
    bool turns() const { return turn || film == "turn" || film == "both"; }
};

/// @throws interaction::Error naming the file of the keys and the first key that these data cannot show
void expect_fit(const std::vector<interaction::KeyFrame>& keys, const std::string& path,
                const Session& session, std::size_t steps);

/// Places the data where `explore` shows them first: they fill the picture where the screen is the
/// viewer's, as in a window.
void fill_picture(const Session& session, const Config& config, const index::SeriesInfo& info,
                  ExplorerState& state);

/// The header that a recording of a first look at this index would have, without its state.
/// `options.recording` names the index.
interaction::RecordingHeader header_of_series(const ReplaySource& options);

/// The recording: the steps pass as fast as playback shows the whole series at first, or as the keys
/// or the turn have it. Sets the session's state to its start.
/// @param rate frames per second: each step is shown for at least one
/// @param file the index @throws UsageError when the series does not have such steps
/// @throws interaction::Error naming the file of keys and the key that does not fit the data
interaction::Recording steps_seen(Session& session, const Config& config,
                                  const index::IndexFile& file,
                                  const interaction::RecordingHeader& header,
                                  const SeriesMovie& movie, double rate);

} // namespace isochron::app
