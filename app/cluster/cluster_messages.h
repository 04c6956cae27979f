// Messages that the processes of a cluster exchange in a frame, and their bytes.
//
// The bytes are CBOR (RFC 8949). Inputs and commands are coded as in recordings
// (interaction/recording), so that they arrive exactly and are checked in one place.
#pragma once

#include "app/cluster/cell_agreement.h"
#include "app/frame/frame_log.h"
#include "app/quality/draw_meter.h"
#include "app/quality/frame_plan.h"
#include "interaction/recording/recording.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// Whether a frame waits for the cells it asked for. Only a fixed-step replay does, so that a
/// recording always gives the same pictures; the live loop never waits.
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

/// From every process to every process, when a frame is drawn and before it is shown.
struct FrameAnswer {
    CellProgress cells;
    bool close = false;              ///< the user closes a window
    std::string failure;             ///< why the process has no cells; empty when all is well
    DrawLoad view;                   ///< load of one cell: the number of views, and their pixels
    std::uint64_t surface_limit = 0; ///< cells that can be drawn as exact surfaces
    bool parts_whole = false;        ///< the picture in parts is whole, or shown
    Milliseconds parts_took{0};      ///< to draw it, while it is whole and not shown
    std::vector<DrawSample> samples; ///< earlier frames whose draw times are now known
    bool operator==(const FrameAnswer&) const = default;
};

using MessageBytes = std::vector<std::uint8_t>;

MessageBytes encoded(const FrameOrder& order);
/// Rank 0 sends its plan to all within the frame.
MessageBytes encoded(const FramePlan& plan);
MessageBytes encoded(const FrameAnswer& answer);
/// The order that ends the session: `decode_order` returns empty for it.
MessageBytes encoded_end();

/// These check every part of the message. @throws interaction::Error when one is wrong
std::optional<FrameOrder> decode_order(std::span<const std::byte> bytes);
FramePlan decode_plan(std::span<const std::byte> bytes);
FrameAnswer decode_answer(std::span<const std::byte> bytes);

} // namespace isochron::app
