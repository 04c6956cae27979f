// The results of a benchmark: rows of figures and the machine, as JSON and as a table.
#pragma once

#include "tests/bench/rows/header.h"
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::bench {

/// One structure on one series. Figures that a structure does not have are empty. Searches run on
/// one thread; times are medians over the steps, in microseconds unless the name says otherwise.
struct Row {
    std::string data, type, structure;
    std::uint64_t steps = 0;
    std::optional<std::uint32_t> l, max_variation;
    unsigned threads = 1;    ///< for building
    double isovalue = 0;     ///< isovalue of the times
    double active = 0;       ///< cells at that isovalue, mean over the steps
    std::uint64_t bytes = 0; ///< without the volume
    double percent_of_raw = 0, percent_with_volume = 0;     ///< raw: steps x cells x 24 bytes
    std::uint64_t false_positives = 0, false_negatives = 0; ///< over all steps and isovalues
    double search_ids_us = 0;
    double search_full_us = 0; ///< ids (tested if they are candidates), positions and normals
    std::optional<double> incremental_full_us; ///< the complete new set
    std::optional<double> delta_ids;           ///< added and removed cells from step to step, mean
    double sweep_ms = 0; ///< all steps once: the mean of forwards and backwards
    // The comparisons, at the same steps and in turn with the structure's own searches:
    double scan_us = 0, tbon_us = 0, flying_edges_us = 0, flying_edges_normals_us = 0;
    double memcpy_us = 0;                  ///< copying the active ids
    std::optional<double> build_mcs_per_s; ///< million cell-steps per second of processor time
};

/// Details that explain a row's false positives; not part of its figures.
struct ErrorDetail {
    std::uint64_t queries = 0;      ///< steps x isovalues
    std::uint64_t active = 0;       ///< truly active cells over all of them
    double percent_at_isovalue = 0; ///< false positives / active at the row's isovalue
    std::uint64_t entries = 0;      ///< stored; 0 if the structure has none
    /// Degrees between a cell's normal at its step and the one stored for a time span, over all
    /// steps at the row's isovalue.
    std::optional<double> normal_error_mean, normal_error_p99;
};

struct Results {
    Header header;
    std::vector<Row> rows;
    std::vector<ErrorDetail> details; ///< one for each row
};

nlohmann::ordered_json to_json(const Results& results);
/// The results as text, one row per line.
std::string to_json_text(const Results& results);

/// Columns for the terminal.
std::string table_of(const Results& results);

} // namespace isochron::bench
