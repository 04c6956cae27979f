// What the motion benchmark measured: a row for each motion of each case.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

namespace isochron::bench {

struct MotionRow {
    std::string data, motion, place; ///< place: `windowless`, `window`
    std::uint64_t cells = 0;         ///< active ones of the volume
    int width = 0, height = 0, eyes = 1;
    double load = 0; ///< load of the machine before it, mean of a minute
    double budget_ms = 0;
    double seconds = 0; ///< that the motion lasts

    // Beside settled pictures: means, and the worst.
    std::size_t pictures = 0;
    double lit = 0, lit_worst = 0;
    double overlap = 0, overlap_worst = 0;
    double luminance_off = 0, luminance_worst = 0, luminance_shift = 0;
    double block_lit_off = 0, block_light_off = 0;
    double specks = 0;
    double pixels_off = 0;
    double recognizable = 0; ///< share of the pictures, see `is_recognizable`

    // While it moved.
    std::string drawn{};           ///< footprints, and levels of detail if coarse
    std::uint64_t drawn_cells = 0; ///< median
    std::size_t frames = 0, redrawn = 0;
    double per_second = 0;                     ///< pictures drawn anew
    double frame_ms = 0;                       ///< median, of those drawn anew
    double over_two = 0, over_three = 0;       ///< share of those over so many promised times
    /// Share of a fixed work over so many times, see FixedWork.
    double control_two = 0, control_three = 0;
    std::optional<double> shown_ms = {},
                          shown_late_ms = {}; ///< asked to shown: median, 95th percentile
    double busy = 0;                          ///< processors, while frames were made

    // After it.
    std::optional<double> exact_ms = {}; ///< empty: not within the time that was given
    double left_off = 0; ///< share of the pixels of what then stood that differ from the settled
};

/// Whether its pictures are on the sheet of all data.
inline bool is_on_sheet(const MotionRow& row) {
    return row.place == "windowless" && row.width == 1280 && row.height == 720;
}

template <class AnyRow, class Field>
void each_field(AnyRow& row, Field&& field)
    requires std::is_same_v<std::remove_const_t<AnyRow>, MotionRow>
{
    field("data", row.data);
    field("motion", row.motion);
    field("place", row.place);
    field("cells", row.cells);
    field("width", row.width);
    field("height", row.height);
    field("eyes", row.eyes);
    field("load", row.load);
    field("budget_ms", row.budget_ms);
    field("seconds", row.seconds);
    field("pictures", row.pictures);
    field("lit", row.lit);
    field("lit_worst", row.lit_worst);
    field("overlap", row.overlap);
    field("overlap_worst", row.overlap_worst);
    field("luminance_off", row.luminance_off);
    field("luminance_worst", row.luminance_worst);
    field("luminance_shift", row.luminance_shift);
    field("block_lit_off", row.block_lit_off);
    field("block_light_off", row.block_light_off);
    field("specks", row.specks);
    field("pixels_off", row.pixels_off);
    field("recognizable", row.recognizable);
    field("drawn", row.drawn);
    field("drawn_cells", row.drawn_cells);
    field("frames", row.frames);
    field("redrawn", row.redrawn);
    field("per_second", row.per_second);
    field("frame_ms", row.frame_ms);
    field("over_two", row.over_two);
    field("over_three", row.over_three);
    field("control_two", row.control_two);
    field("control_three", row.control_three);
    field("shown_ms", row.shown_ms);
    field("shown_late_ms", row.shown_late_ms);
    field("busy", row.busy);
    field("exact_ms", row.exact_ms);
    field("left_off", row.left_off);
}

} // namespace isochron::bench
