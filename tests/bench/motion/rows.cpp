// The rows of the motion benchmark.
#include "tests/bench/motion/rows.h"

#include "tests/bench/rows/record_json.h"

namespace isochron::bench {
namespace {

std::string of(const std::optional<double>& number) {
    return number ? fmt::format("{:.0f}", *number) : "-";
}

} // namespace

std::string to_json_text(const MotionResults& results) {
    return results_text(results);
}

std::string motion_table_head() {
    return "rec: recognizable pictures; lit: lit area over the settled picture's; IoU: of both, "
           "widened by a pixel; lum: "
           "luminance off where both are lit (each: mean, worst);\nblocks: lit area and light off "
           "in blocks of 16 x 16; pix: pixels off by more than 8 of 255; /s: pictures a second; "
           "ms: median frame;\n>2, >3: frames over so many promised times (control); asked: until "
           "shown, median and 95 %; exact: after stopping, ms; busy: processors\n"
           "data      size        ms   motion   rec % lit         IoU         lum %    blocks %  "
           "pix %  "
           " /s   ms  >2 %        >3 %        asked ms   exact (off %)  busy  drawn\n";
}

std::string motion_table_line(const MotionRow& row) {
    const auto size = row.eyes == 2 ? fmt::format("2x{}x{}", row.width, row.height)
                                    : fmt::format("{}x{}", row.width, row.height);
    return fmt::format(
        "{:<9} {:<10} {:>5.3g} {:<8} {:>4.0f}  {:.2f} {:<6.2f} {:.3f} {:<5.3f} {:>4.1f} {:<4.1f} "
        "{:>4.0f} "
        "{:<4.0f} {:>5.1f} {:>4.0f} {:>5.1f}  {:>4.1f} ({:.1f}) {:>4.1f} ({:.1f}) {:>4} {:<5} "
        "{:>5} ({:.2f}) {:>6.2f}  {} of {} cells: {}\n",
        row.data, row.place == "window" ? "window" : size, row.budget_ms, row.motion,
        100 * row.recognizable, row.lit, row.lit_worst, row.overlap, row.overlap_worst,
        100 * row.luminance_off, 100 * row.luminance_worst, 100 * row.block_lit_off,
        100 * row.block_light_off, 100 * row.pixels_off, row.per_second, row.frame_ms,
        100 * row.over_two, 100 * row.control_two, 100 * row.over_three, 100 * row.control_three,
        of(row.shown_ms), of(row.shown_late_ms), of(row.exact_ms), 100 * row.left_off, row.busy,
        row.drawn_cells, row.cells, row.drawn);
}

} // namespace isochron::bench
