// What is said to clients of the control socket: lines of JSON, some with bytes behind them.
#pragma once

#include "app/control/control_desk.h"
#include "app/control/control_request.h"

#include <cstddef>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace isochron::app {

inline constexpr std::size_t kLargestAnswer = std::size_t{256} << 20; ///< [byte] behind a line

/// A line with its end, and the bytes behind it, whose number the line says as `bytes`.
struct ControlAnswer {
    std::string line;
    std::shared_ptr<const std::vector<std::byte>> bytes = nullptr; ///< null: none
    bool shared = false;                                           ///< others get the same bytes
};

/// @param id of the request, as JSON
ControlAnswer refused(const std::string& id, const std::string& why);
/// A request is done. @param frame that obeys it; 0: it is of no frame
ControlAnswer done(const std::string& id, std::uint64_t frame = 0);
ControlAnswer state_answer(const std::string& id, const ShownFrame& shown);
/// Red, green and blue of each pixel, sRGB, the top row first.
std::shared_ptr<const std::vector<std::byte>> picture_bytes(const ControlPicture& picture);
/// @param bytes of the picture, which all its answers share
ControlAnswer picture_answer(const std::string& id, const ControlPicture& picture,
                             std::shared_ptr<const std::vector<std::byte>> bytes);
/// Answers `cells`, `mesh` or `profile` by a search of its own, of all cells.
///
/// Cells: bytes as of `query --ids`. Mesh: the points as three float32 each, as `export` has them,
/// then as many normals, then the triangles as three uint32 each. Profile: `index::rows_of` as float64.
/// @param shown says what the request does not
/// @throws index::Error: no such step or array, no ruler, damage, an answer of more than `kLargestAnswer`;
/// Stopped
ControlAnswer searched_answer(const std::string& id, const ControlRequest& request,
                              const std::shared_ptr<const index::IndexFile>& file,
                              const ExplorerState& shown, const std::stop_token& stop);

/// What has changed in a topic from one frame to a later one, as an event; empty: nothing.
/// @param before empty: everything is new
std::string event_line(ControlTopic topic, const ShownFrame* before, const ShownFrame& now);

} // namespace isochron::app
