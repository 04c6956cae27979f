// The controls of a story: its steps, and the way to what each of them shows.
#pragma once

#include "interaction/commands.h"
#include "interaction/control_context.h"
#include "interaction/input/device_reading.h"
#include "interaction/navigation/key_motion.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::interaction {

inline constexpr Seconds kStoryMove{1.2}; ///< to the view of a step
inline constexpr Seconds kStoryLeap{0.2}; ///< until the picture is dark and the view leaps there

/// Whoever sets `Settings::story` is followed. Commands that come of a step hold `story`, also in the
/// frames that follow it: by that the history tells them from changes that the user made.
class StoryControls {
  public:
    /// @param commands of the frame so far; a user who moves the data takes the view over
    void update(const Reading& now, const ControlContext& context, Seconds time, Commands& commands,
                std::vector<std::string>& notes);
    /// Whether the next frame has something to show of a story. @param told `Settings::story`
    bool goes_on(std::uint32_t told) const { return way_ || (told_ && *told_ != told); }

  private:
    struct Way {
        Seconds began;
        Commands leap;                         ///< what is set when the picture is dark
        std::optional<KeyedSimilarity> motion; ///< empty: it leaps
        Similarity last;                       ///< that the way has set
    };

    std::uint32_t asked_for(const Reading& now, const Settings& settings,
                            std::vector<std::string>& notes);
    void begin(const KeyFrame& key, const Reading& now, const ControlContext& context, Seconds time,
               Commands& commands);
    void go_on(const Settings& settings, Seconds time, Commands& commands);

    std::optional<std::uint32_t> told_; ///< in the last frame
    std::optional<Way> way_;
    double pushed_ = 0; ///< the stick in the last frame
};

} // namespace isochron::interaction
