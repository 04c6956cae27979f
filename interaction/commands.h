// Commands: what input led to in one frame. Recordings store them, replays obey them.
#pragma once

#include "interaction/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace isochron::interaction {

/// A vibration for a hand whose device can vibrate.
struct HapticPulse {
    std::string hand = "wand"; ///< name of the device
    double seconds = 0;        ///< 0 to kLongestPulse
    float amplitude = 0;       ///< 0 to 1; 1 is the device's strongest
    bool operator==(const HapticPulse&) const = default;
};
inline constexpr double kLongestPulse = 1.0; ///< [s]

/// Changes of settings, and what happens once. Changes are absolute results, not increments:
/// applying them again changes nothing.
struct Commands : SettingChanges {
    std::optional<double> isovalue; ///< isovalue of the picked surface
    /// Another fraction of the way from the step that is shown to the next one; not beside `instant`.
    std::optional<std::uint32_t> fraction;
    bool screenshot = false;
    bool copy =
        false; ///< the value under the pointer, or of the mark, as a text to paste elsewhere
    bool save = false; ///< the session is saved now
    bool quit = false;
    bool undo = false; ///< the settings in these commands undo the newest change
    bool redo = false; ///< the settings in these commands redo the change that was undone last
    std::vector<std::string> stamps;  ///< named moments of a recording
    std::vector<HapticPulse> haptics; ///< to be played now by the backend that has the devices
    bool operator==(const Commands&) const = default;
    bool empty() const { return *this == Commands{}; }
};

// Both use the list of fields and are defined beside it, in command_fields.cpp.

/// Fields set in `later` win; stamps and haptics are appended.
void merge(Commands& into, const Commands& later);

/// The keys of the fields in which two differ.
std::vector<std::string> differences(const Commands& a, const Commands& b);

} // namespace isochron::interaction
