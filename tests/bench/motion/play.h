// Plays a motion in a session in real time, and keeps some of what was shown.
#pragma once

#include "app/config/config.h"
#include "app/frame/pacer.h"
#include "app/session/session.h"
#include "tests/bench/motion/row.h"
#include "tests/bench/motion/script.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace isochron::bench {

/// A picture that was shown, and what it showed.
struct ShownPicture {
    std::vector<render::Image> eyes;
    app::ExplorerState state; ///< with the step and the isovalues of the shown cells
    interaction::InputState input;
    std::size_t number = 0; ///< number of the moment in the motion
};

/// What a motion left behind, before its pictures are compared.
struct Played {
    MotionRow row;
    std::vector<ShownPicture> moving;
    ShownPicture stopped;
};

struct PlayOptions {
    double seconds = 1.7;     ///< length of a motion
    double every = 8.0 / 30;  ///< [s] between pictures that are kept
    double longest_rest = 12; ///< [s] that the picture after it may take
};

/// Moments of a motion at which pictures are kept: the same for all budgets.
std::vector<double> kept_moments(const PlayOptions& options);

/// The eyes' pictures of the last frame.
std::vector<render::Image> shown_by(const app::Session& session);

/// A session in which motions are played one after the other.
class Player {
  public:
    using Check = std::function<void()>; ///< called in each frame; may throw

    /// @param windows as a session takes them
    Player(const app::Config& config, std::shared_ptr<const index::IndexFile> file,
           stereo::Windows windows, const PlayOptions& options, Check check);

    app::Session& session() { return session_; }
    Played play(Motion motion, const app::ExplorerState& start);

  private:
    /// Shows a state and waits until its picture is final. @param longest [s]
    bool settle(const app::ExplorerState& state, double longest);
    double now() const;
    const app::FrameReport& frame(const MotionScript& script, double at,
                                  const interaction::Commands& commands);
    bool is_final() const;
    ShownPicture shown(const interaction::InputState& input) const;

    app::Config config_;
    std::shared_ptr<const index::IndexFile> file_;
    PlayOptions options_;
    Check check_;
    app::Session session_;
    app::Pacer pacer_;
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
    interaction::InputState input_; ///< input of the last frame
    bool fresh_ = true;             ///< nothing has been played yet
};

} // namespace isochron::bench
