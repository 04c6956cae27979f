// What is known of a field of a record, such as its key in recordings and the values it may have.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace isochron::interaction {

inline constexpr double kAnyNumber = std::numeric_limits<double>::max();
inline constexpr std::size_t kLongestText = 256;       ///< [byte]
inline constexpr std::size_t kLongestArrayName = 4096; ///< [byte] of an array
inline constexpr std::size_t kMostEvents = 64;         ///< stamps, or haptic pulses, of one frame

/// The properties of a field, which are the same in every record that has it.
struct Field {
    const char* key;
    double low = -kAnyNumber, high = kAnyNumber; ///< range of a number, or of each number of a list
    std::size_t least = 0, most = kLongestText;  ///< items of a list, or bytes of a text
    const char* old_key = nullptr;               ///< the key in recordings of older versions
    bool undone = true;                          ///< changes of the setting can be undone
    bool may_lack = false;  ///< older recordings may lack it: then it has its default
    bool dragged = false;   ///< changes in quick succession are undone as one
    bool any_order = false; ///< whether the two numbers of a range may descend

    // In configuration files, where a key may be a path: `rendering.near`.
    const char* configured = nullptr; ///< a setting's key there; null: none says how it begins
    bool in_files = true;             ///< false: recordings alone have the field of a record
    double per = 1.0; ///< units of the file in one of the member's: 1000 where those are ms and s
    std::array<const char*, 2> words{}; ///< for false and true; null: `false` and `true`
    const char* one = nullptr;          ///< for a list: the key of a table that is the one item
    bool told = false;                  ///< written even where it is the default
};

} // namespace isochron::interaction
