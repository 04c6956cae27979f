// Key frames of a film: from what is seen at some times to a recording of all its frames.
//
//     const std::vector<KeyFrame> keys = keys_from(text, "keys.json");
//     recording.frames = frames_of(keys, {.start = settings, .seen = devices, .times = times});
//
// Between keys the view moves so that its speed does not jump. The data turn about the place that
// moves least, the shortest way; that place keeps between its places at both keys along each axis;
// the scale goes geometrically. A view that both keys share in scale or turn keeps it.
#pragma once

#include "interaction/navigation/key_frames.h"
#include "interaction/recording/recorded_frame.h"
#include "interaction/step_gaps.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::interaction {

/// What a film of keys is made in.
struct KeyScene {
    Settings start{};         ///< settings that the recording starts from
    InputState seen{};        ///< devices of all frames, except for the keys' heads
    StepTimes times{};        ///< when the steps are; not empty
    glm::dvec3 pivot{0.0};    ///< center of the data, physical space
    double rate = 30.0;       ///< frames a second
    bool titled = false;      ///< frames say which key's title is seen, by `Settings::story`
    bool logarithmic = false; ///< isovalues above 0 change by equal factors in equal times
};

/// The frames of a film, from its time 0, at which the first key is seen, to the end of the last
/// key's rest.
///
/// Positions, the scale's logarithm, isovalues and time go by monotone cubics (Fritsch and Butland,
/// SIAM J. Sci. Stat. Comput. 5, 1984, doi:10.1137/0905021), so that they never leave the range of
/// the two keys around them; turns go by a cubic of the rotation vector. All rest at the first and
/// last key and at keys with a hold; if the first and last key share their view, the film goes
/// through it as through any other key. A position that changes together with the scale moves so
/// that the place of the data that both keys show at one place of the room stays there.
/// @param keys by time, each at least kShortestMove behind the end of the one before; not empty
std::vector<RecordedFrame> frames_of(std::span<const KeyFrame> keys, const KeyScene& scene);

/// The file of keys: a JSON object of `format`, `version` and `keys`, as docs/FORMATS.md says.
/// @param data name of the index that a story is about; empty: the file names none
std::string keys_text(std::span<const KeyFrame> keys, const std::string& data = {});
/// @param name of the file, for messages
/// @param data gets the name of the index, as the file says it; null: it is not wanted
/// @throws Error in one line, naming file and key: not keys, a newer version, keys out of order, ...
std::vector<KeyFrame> keys_from(std::string_view text, const std::string& name,
                                std::string* data = nullptr);

} // namespace isochron::interaction
