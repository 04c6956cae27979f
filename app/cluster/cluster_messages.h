// What the processes of a cluster say to each other in a frame, as bytes.
//
// Bytes are CBOR (RFC 8949): inputs and commands are those of a recording (interaction/
// recording_json.h), so that whatever a recording can hold reaches every process, exactly, and is
// checked in one place.
#pragma once

#include "app/cluster/cell_agreement.h"
#include "app/frame/draw_meter.h"
#include "app/frame/frame_log.h"
#include "interaction/recording/recording.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// Whether a frame waits for the cells it asked for: only a fixed-step replay does, so that the
/// same recording gives the same pictures. The live loop never waits.
enum class Waiting : std::uint8_t { never, for_cells };

/// From rank 0 to all, before a frame.
struct FrameOrder {
    interaction::InputState input;
    interaction::Commands commands;
    Waiting waiting = Waiting::never;
    CellOrder cells;
    interaction::InputState latched; ///< where the viewers' heads are when the views are made
    bool operator==(const FrameOrder&) const = default;
};

/// From rank 0 to all, within a frame: what it is drawn with, once for all eyes and windows.
struct FrameChoice {
    render::Footprint footprint = render::Footprint::quad;
    QualityReason reason = QualityReason::moving;
    bool final = false;   ///< the picture is as good as it gets for these cells
    bool measure = false; ///< draw even if nothing has changed
    bool mesh = false;    ///< the sets asked for from now on come with a mesh
    bool operator==(const FrameChoice&) const = default;
};

/// From everybody to everybody, when a frame is drawn and before it is shown.
struct FrameAnswer {
    CellProgress cells;
    bool close = false;              ///< the user closes a window
    std::string failure;             ///< why it has no cells; empty when all is well
    DrawLoad view;                   ///< of one cell: the number of views, and their pixels
    std::uint64_t surface_limit = 0; ///< cells that can be drawn as exact surfaces
    std::vector<DrawSample> samples; ///< frames whose times have become known
    bool operator==(const FrameAnswer&) const = default;
};

using MessageBytes = std::vector<std::uint8_t>;

MessageBytes encoded(const FrameOrder& order);
MessageBytes encoded(const FrameChoice& choice);
MessageBytes encoded(const FrameAnswer& answer);
/// Says that there are no more frames: an order, empty when decoded.
MessageBytes encoded_end();

/// Anything that is not such a message, in every part, throws interaction::Error.
std::optional<FrameOrder> decode_order(std::span<const std::byte> bytes);
FrameChoice decode_choice(std::span<const std::byte> bytes);
FrameAnswer decode_answer(std::span<const std::byte> bytes);

} // namespace isochron::app
