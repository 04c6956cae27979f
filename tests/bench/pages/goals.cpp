// The goals of the index, compared with the measured figures.
#include "tests/bench/pages/goals.h"

#include "tests/bench/pages/goal.h"

#include <functional>
#include <optional>
#include <vector>

namespace isochron::bench {

namespace {

using Figure = std::function<std::optional<double>(const Row&)>;

/// The figure for rows of one structure, series (`sphere`; empty: any) and type (empty: any).
Figure of(const std::string& structure, const std::string& data, const std::string& type,
          const Figure& figure) {
    return [=](const Row& row) -> std::optional<double> {
        if (row.structure != structure || (!data.empty() && row.data != data) ||
            (!type.empty() && row.type != type))
            return std::nullopt;
        return figure(row);
    };
}

std::optional<double> size(const Row& row) {
    return row.percent_of_raw;
}

std::optional<double> over_scan(const Row& row) {
    return row.scan_us / row.search_ids_us;
}

std::optional<double> errors_of_exact(const Row& row) {
    if (row.structure.starts_with("thi"))
        return std::nullopt; // its false positives are those of the published method
    return static_cast<double>(row.false_positives + row.false_negatives);
}

std::optional<double> over_memcpy(const Row& row) {
    constexpr double kLarge = 90'000;
    if (row.active < kLarge)
        return std::nullopt;
    return row.search_ids_us / row.memcpy_us;
}

std::optional<double> incremental_gain(const Row& row) {
    if (!row.incremental_us)
        return std::nullopt;
    return row.search_ids_us / *row.incremental_us;
}

std::vector<Goal<Row>> all_goals() {
    const auto build = [](const Row& row) { return row.build_mcs_per_s; };
    return {
        {"false positives and negatives, all types, steps and isovalues", "", 0, 0, false,
         errors_of_exact},
        {"cells (u8), sphere, of raw", " %", 4.5, 7, false, of("cells", "sphere", "u8", size)},
        {"cells + deltas (u8), sphere, of raw", " %", 9, 14, false,
         of("cells+deltas", "sphere", "u8", size)},
        {"cells (u8), vorticity 64^3, of raw", " %", 9, 11, false,
         of("cells", "vorticity64", "u8", size)},
        {"cells (u8), 256^3, of raw", " %", 6.7, 9, false, of("cells", "fourier256", "u8", size)},
        {"bricks (u8), of raw", " %", 0.07, 0.1, false, of("bricks", "", "u8", size)},
        {"bricks (f32), of raw, above the plain volume", " %", 0.08, 0.1, false,
         of("bricks", "", "f32", size)},
        {"ids from bricks (f32) against the scan, sphere", "x", 6, 2, true,
         of("bricks", "sphere", "f32", over_scan)},
        {"ids from bricks (f32) against the scan, vorticity 64^3", "x", 3, 1.5, true,
         of("bricks", "vorticity64", "f32", over_scan)},
        {"ids from bricks (f32) against the scan, 256^3", "x", 40, 12, true,
         of("bricks", "fourier256", "f32", over_scan)},
        {"ids from cells (u8) against flying edges, sphere", "x", 500, 100, true,
         of("cells", "sphere", "u8",
            [](const Row& row) { return row.flying_edges_us / row.search_ids_us; })},
        {"ids, positions and normals (u8) against flying edges with normals, sphere", "x", 20, 8,
         true,
         of("cells", "sphere", "u8",
            [](const Row& row) { return row.flying_edges_normals_us / row.search_full_us; })},
        {"ids from cells (u8), time of memcpy of them, 90,000 cells or more", "x", 2, 3.5, false,
         of("cells", "", "u8", over_memcpy)},
        {"ids from cells (u8) against the scan, sphere", "x", 12, 5, true,
         of("cells", "sphere", "u8", over_scan)},
        {"ids from cells (u8) against the scan, 256^3", "x", 60, 25, true,
         of("cells", "fourier256", "u8", over_scan)},
        {"incremental against full (u8), sphere", "x", 10, 5, true,
         of("cells+deltas", "sphere", "u8", incremental_gain)},
        {"incremental against full (u8), vorticity 64^3", "x", 1.4, 1.2, true,
         of("cells+deltas", "vorticity64", "u8", incremental_gain)},
        {"building of cells (u8), per core", " Mcs/s", 300, 100, true,
         of("cells", "", "u8", build)},
        {"building of bricks, per core", " Mcs/s", 1500, 500, true, of("bricks", "", "", build)},
    };
}

} // namespace

std::string goals_table(const Results& results) {
    return table_of(all_goals(), results.rows);
}

} // namespace isochron::bench
