// The part of the page of results on the picture in motion.
#include "tests/bench/pages/motion_page.h"

#include "app/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace isochron::bench {
namespace {

constexpr std::string_view kHowMotionsAreMeasured =
    "Each motion is played in real time, in a session that had settled: *sway*, "
    "a head that moves by three centimeters; *walk-in*, 2.4 m to the data and into them; *orbit*, "
    "the data turn by a radian a second; *scrub*, the isovalue goes up and down by 12 %; "
    "*jump-on*, four other steps a second. At every eighth picture of 33 ms the eyes' picture is "
    "read; later another session, which waits for its cells, draws the settled picture of the "
    "same view, step and isovalue, and the view without cells.\n\n"
    "- A pixel is lit when a channel differs by more than 8 of 255 from the view without cells. "
    "*lit*: lit area over that of the settled picture. *IoU*: what both light over what either "
    "lights, both widened by a pixel. *lum*: mean difference of luminance (of display values) "
    "where both are lit, over the settled mean there. *blocks*: differences of lit area and of "
    "the light that cells bring, in blocks of 16 x 16 pixels, over the settled sum: for specks "
    "below four pixels, of which IoU says nothing. *pixels*: share of all pixels that differ by "
    "more than 8 of 255. Means; in brackets the worst picture.\n"
    "- *recognizable*: pictures with a lit area off by at most 10 % and an IoU of at least 0.85; "
    "where most of what is lit are specks, with both figures of blocks at most 15 %.\n"
    "- *pictures/s*: drawn anew. *frame*: median of those. *> 2x, > 3x*: share of them that took "
    "more than so many promised times; in brackets the same of a control that does a fixed work "
    "of as much processor time on all processors, right after the motion. *asked to shown*: from "
    "the frame "
    "that asks for an isovalue or a step to the one that shows it or a newer one: median and 95 "
    "%. *exact*: from the last frame in which something moved until nothing gets better any more; "
    "in brackets the share of its pixels that then differ from the settled picture. *busy*: "
    "processors, while frames were made.\n"
    "- `window`: in a window of its own, under Xvfb, with what the program has by default, and "
    "with its panel; its promised time is one period of the display.\n"
    "- The data: `demo` is `isochron generate vorticity`; `192` to `1024` are turbulence of 64 "
    "Fourier modes of so many vertices along each axis; `tubes` run along the lines where two "
    "sums of waves are 0; `specks` are one to three voxels large; `two` are two translucent "
    "surfaces in 128^3; `colored` is as `192`, colored by another array.\n\n";

std::string size_of_picture(const MotionRow& row) {
    return fmt::format("{}{}x{}{}", row.eyes == 2 ? "2x" : "", row.width, row.height,
                       row.place == "window" ? " window" : "");
}

std::string milliseconds(const std::optional<double>& time) {
    return time ? fmt::format("{:.0f}", *time) : "-";
}

std::string motion_line(const MotionRow& row) {
    return fmt::format(
        "| {} | {} | {:.3g} | {} | {:.0f} % | {:.2f} ({:.2f}) | {:.3f} ({:.3f}) | {:.1f} ({:.1f}) "
        "% | {:.0f}, {:.0f} % | {:.1f} % | {:.0f} | {:.0f} | {:.1f} ({:.1f}) % | {:.1f} ({:.1f}) "
        "% | {}, {} | {} ({:.2f} %) | {:.2f} | {} of {}: {} |\n",
        row.data, size_of_picture(row), row.budget_ms, row.motion, 100 * row.recognizable, row.lit,
        row.lit_worst, row.overlap, row.overlap_worst, 100 * row.luminance_off,
        100 * row.luminance_worst, 100 * row.block_lit_off, 100 * row.block_light_off,
        100 * row.pixels_off, row.per_second, row.frame_ms, 100 * row.over_two,
        100 * row.control_two, 100 * row.over_three, 100 * row.control_three,
        milliseconds(row.shown_ms), milliseconds(row.shown_late_ms), milliseconds(row.exact_ms),
        100 * row.left_off, row.busy, app::grouped(row.drawn_cells), app::grouped(row.cells),
        row.drawn);
}

/// The load of the machine before the motions, which includes the benchmark's own.
std::string loads(const std::vector<MotionRow>& rows) {
    if (rows.empty())
        return "unknown";
    const auto [low, high] = std::ranges::minmax(rows, {}, &MotionRow::load);
    return fmt::format("{:.1f} to {:.1f}", low.load, high.load);
}

/// The data of which there is a row of pictures on the sheet, or the motions that are its columns.
std::string on_sheet(const std::vector<MotionRow>& rows, std::string MotionRow::* name) {
    std::vector<std::string> names;
    for (const MotionRow& row : rows)
        if (is_on_sheet(row) && std::ranges::find(names, row.*name) == names.end())
            names.push_back(row.*name);
    return fmt::format("{}", fmt::join(names, ", "));
}

} // namespace

std::string motion_section(const MotionResults& results, const std::string& source,
                           const std::string& sheet) {
    const Header& header = results.header;
    std::string text = fmt::format(
        "\n# The picture in motion\n\nMade from `{}`, which `./run bench motion` wrote. Measured "
        "on {} with commit {}, {}, on {}, {} threads; load of the machine {}. A motion lasts "
        "{:.3g} s.\n\n",
        source, header.date, header.commit, header.compiler, header.processor, header.threads,
        loads(results.rows), results.rows.empty() ? 0 : results.rows.front().seconds);
    text += kHowMotionsAreMeasured;
    text += "## Goals of the picture in motion\n\nThe worst row that a goal speaks of decides.\n\n";
    text += motion_goals_table(results.rows) + "\n";
    if (!sheet.empty())
        text += fmt::format("## Moving above settled\n\nOf each motion the picture that is least "
                            "like its settled one, at 33 ms: from left to right {}; from above "
                            "{}.\n\n"
                            "![Moving pictures above the settled pictures of the same "
                            "views]({})\n\n",
                            on_sheet(results.rows, &MotionRow::motion),
                            on_sheet(results.rows, &MotionRow::data), sheet);
    text += "## Every motion\n\n"
            "| data | picture | ms | motion | recognizable | lit | IoU | lum | blocks | pixels | "
            "pictures/s | frame ms | > 2x | > 3x | asked to shown ms | exact ms | busy | cells "
            "drawn |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const MotionRow& row : results.rows)
        text += motion_line(row);
    return text;
}

} // namespace isochron::bench
