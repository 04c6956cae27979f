// Key frames of a film: adding and removing them, and showing one in a session.
#pragma once

#include "interaction/commands.h"
#include "interaction/pose.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace isochron::interaction {

/// Seconds from a film's begin to its end.
double seconds_of(std::span<const KeyFrame> keys);

/// A key of what is seen, with all settings that keys hold.
KeyFrame key_of(const Settings& settings, const Pose& head);

inline constexpr double kKeySeconds = 2.0; ///< [s] from the rest at a new key's predecessor to it

/// The keys with a further one at their end; the same ones if there is no room for more.
std::vector<KeyFrame> with_key(std::vector<KeyFrame> keys, KeyFrame key);
/// The keys without one of them; the first key that is left comes at once.
std::vector<KeyFrame> without_key(std::vector<KeyFrame> keys, std::size_t number);

/// The keys with one of them at another time: not before its predecessor's rest ends, and so that it
/// rests before its successor. The first one stays at 0.
std::vector<KeyFrame> with_moved_key(std::vector<KeyFrame> keys, std::size_t number, double time);
/// The keys with another rest at one of them; those behind come so much later or sooner.
std::vector<KeyFrame> with_held_key(std::vector<KeyFrame> keys, std::size_t number, double hold);
/// A range of values so wide that equal factors, not equal differences, look alike.
bool is_wide_range(double low, double high);

/// Commands that show a key: only what differs from what is seen. The data stand to the viewer's
/// place and heading as they stood to the key's; time that plays pauses.
Commands way_to_key(const KeyFrame& key, const Settings& now, const Pose& viewer);
/// Number of the first key that is seen.
std::optional<std::size_t> seen_key(const Settings& now, const Pose& viewer);

/// Keys of one turn about the data's up axis, physical z, at one speed, while the other settings
/// stay and time goes from one instant to another.
/// @param pivot center of the data, physical space
std::vector<KeyFrame> turn_keys(const Settings& settings, const glm::dvec3& pivot, Instant first,
                                Instant last, double seconds);

inline constexpr double kViewSeconds = 3.0; ///< [s] of a move between saved viewpoints, on average
/// Keys of a film from each viewpoint to the next, all at one speed: meters that the data's center
/// moves, radians that they turn and the logarithm of their growth, added.
/// @param views two at least @param pivot center of the data, physical space
std::vector<KeyFrame> view_keys(std::span<const Viewpoint> views, const glm::dvec3& pivot);

/// Sets all that a key holds, except for the head.
void show_key(const KeyFrame& key, Settings& settings);
/// The isosurfaces that a key shows, if it says something of them. @param before what is shown before
std::optional<std::vector<Isosurface>> surfaces_of(const KeyFrame& key, const Settings& before);
/// A whole state as files keep it: without an empty list of keys and a story that is not told, which
/// earlier versions do not know.
Commands kept_state(Commands state);
/// Commands for the settings that differ. @param undone only for those that undo brings back
Commands changes(const Settings& from, const Settings& to, bool undone = false);

} // namespace isochron::interaction
