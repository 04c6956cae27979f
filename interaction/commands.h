// What input led to in one frame: the commands that a recording stores and a replay obeys.
#pragma once

#include "interaction/pose.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::interaction {

enum class QualityMode : std::uint8_t { automatic, fast, quality }; ///< `auto`, `fast`, `quality`

inline constexpr double kSlowest = 1.0 / 64.0, kFastest = 64.0; ///< playback speeds
inline constexpr float kWidestEyes = 0.1f;                      ///< [m]

/// How time plays. Speed is steps' physical time per second, as a factor of the base speed that
/// plays the whole series in 10 s.
struct PlaybackState {
    bool playing = false;
    bool reverse = false;
    bool loop = true;
    double speed = 1.0; ///< kSlowest to kFastest
    bool operator==(const PlaybackState&) const = default;
};

/// A place in the data to come back to.
struct Viewpoint {
    std::string name;
    Similarity room_from_physical;
    bool operator==(const Viewpoint&) const = default;
};
inline constexpr std::size_t kMostViews = 64;

/// Absolute results, not increments: applying them again changes nothing.
struct Commands {
    std::optional<double> isovalue;
    std::optional<std::uint32_t> step;
    std::optional<PlaybackState> playback;
    std::optional<Similarity> room_from_physical; ///< navigation's result
    std::optional<QualityMode> quality;
    std::optional<float> eye_separation;         ///< metres, 0 to kWidestEyes
    std::optional<std::string> stereo;           ///< a stereo mode's name
    std::optional<bool> panel;                   ///< panel shown
    std::optional<bool> grid;                    ///< floor grid shown
    std::optional<std::vector<Viewpoint>> views; ///< all saved ones, at most kMostViews
    bool screenshot = false;
    bool quit = false;
    std::vector<std::string> stamps; ///< named moments of a recording
    bool empty() const;
    bool operator==(const Commands&) const = default;
};

/// Fields set in `later` win; stamps are appended.
void merge(Commands& into, const Commands& later);

} // namespace isochron::interaction
