// Stories: the key frames that have texts, told one after the other.
#pragma once

#include "interaction/settings.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace isochron::interaction {

/// `front arrives`, or of a key without a name `key 3`. @param number of the key, from 0
std::string name_of_key(std::span<const KeyFrame> keys, std::size_t number);

/// What stands over a film at a key: its name, its text, or both in two lines; empty: neither.
std::string title_of_key(const KeyFrame& key);
bool has_titles(std::span<const KeyFrame> keys);
/// The key whose title stands over a film of the keys, as `Settings::story` has it: from the key on,
/// while the film rests there and for 2 s at least, but not beyond the next key. 0: none.
std::uint32_t titled_key(std::span<const KeyFrame> keys, double time);

/// The key that is told; null: none, or it has no text.
const KeyFrame* told_key(const Settings& settings);

/// A step of a story: a key with a text.
struct StoryStep {
    std::uint32_t number = 0, of = 0; ///< from 1, among the steps; `of` 0: there is no story
    /// Keys that the steps before and after it are, as `Settings::story` has them; 0: there is none.
    std::uint32_t previous = 0, next = 0;
};
/// @param told as `Settings::story` has it, of any key: 0 is before the first step
StoryStep story_step(std::span<const KeyFrame> keys, std::uint32_t told);

/// `2 of 4: front arrives`; without a name `2 of 4`. @param told has a text
std::string story_heading(std::span<const KeyFrame> keys, std::uint32_t told);

} // namespace isochron::interaction
