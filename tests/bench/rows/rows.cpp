// Rows of figures as JSON and as a table.
#include "tests/bench/rows/rows.h"

#include "app/text.h"
#include "tests/bench/rows/record_json.h"

#include <fmt/format.h>

namespace isochron::bench {

/// Calls `field(key, member)` for all figures of a row, in the order of the keys.
template <class AnyRow, class Field>
void each_field(AnyRow& row, Field&& field)
    requires std::is_same_v<std::remove_const_t<AnyRow>, Row>
{
    field("data", row.data);
    field("type", row.type);
    field("steps", row.steps);
    field("structure", row.structure);
    field("l", row.l);
    field("max_variation", row.max_variation);
    field("threads", row.threads);
    field("isovalue", row.isovalue);
    field("active", row.active);
    field("bytes", row.bytes);
    field("percent_of_raw", row.percent_of_raw);
    field("percent_with_volume", row.percent_with_volume);
    field("false_positives", row.false_positives);
    field("false_negatives", row.false_negatives);
    field("search_ids_us", row.search_ids_us);
    field("search_full_us", row.search_full_us);
    field("incremental_full_us", row.incremental_full_us);
    field("delta_ids", row.delta_ids);
    field("sweep_ms", row.sweep_ms);
    field("scan_us", row.scan_us);
    field("tbon_us", row.tbon_us);
    field("flying_edges_us", row.flying_edges_us);
    field("flying_edges_normals_us", row.flying_edges_normals_us);
    field("memcpy_us", row.memcpy_us);
    field("build_mcs_per_s", row.build_mcs_per_s);
}

template <class AnyDetail, class Field>
void each_field(AnyDetail& detail, Field&& field)
    requires std::is_same_v<std::remove_const_t<AnyDetail>, ErrorDetail>
{
    field("queries", detail.queries);
    field("active", detail.active);
    field("percent_at_isovalue", detail.percent_at_isovalue);
    field("entries", detail.entries);
    field("normal_error_mean", detail.normal_error_mean);
    field("normal_error_p99", detail.normal_error_p99);
}

namespace {

std::string cell_text(double value) {
    return value >= 100 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string cell_text(const std::optional<double>& value) {
    return value ? cell_text(*value) : "-";
}

std::string line_of(const Row& row, const ErrorDetail& detail) {
    const auto setting = row.l ? fmt::format("L {} MV {}", *row.l, *row.max_variation) : "";
    return fmt::format("{:<20} {:<12} {:>11} {:>7.3g} {:>7.3g} {:>7.3g} {:>5} {:>8} {:>8} {:>8} "
                       "{:>8} {:>7}\n",
                       row.structure, setting, app::human_bytes(static_cast<double>(row.bytes)),
                       row.percent_of_raw, row.percent_with_volume, detail.percent_at_isovalue,
                       row.false_negatives, cell_text(row.search_ids_us),
                       cell_text(row.search_full_us), cell_text(row.incremental_full_us),
                       cell_text(row.sweep_ms), cell_text(row.build_mcs_per_s));
}

} // namespace

ordered_json to_json(const Results& results) {
    ordered_json j{{"header", record_to_json(results.header)},
                   {"rows", ordered_json::array()},
                   {"details", ordered_json::array()}};
    for (const Row& row : results.rows)
        j["rows"].push_back(record_to_json(row));
    for (const ErrorDetail& detail : results.details)
        j["details"].push_back(record_to_json(detail));
    return j;
}

std::string to_json_text(const Results& results) {
    return json_text(to_json(results));
}

std::string table_of(const Results& results) {
    std::string text;
    const Row* before = nullptr;
    for (std::size_t i = 0; i < results.rows.size(); ++i) {
        const Row& row = results.rows[i];
        if (!before || before->data != row.data || before->type != row.type ||
            before->steps != row.steps)
            text += fmt::format(
                "\n{} {}, {} steps, isovalue {:.5g}: {:.0f} active cells, {} added or removed per "
                "step\nus: scan {}, tbon {}, flying edges {}, with normals {}, memcpy {}; errors "
                "over {} queries\n"
                "{:<20} {:<12} {:>11} {:>7} {:>7} {:>7} {:>5} {:>8} {:>8} {:>8} {:>8} {:>7}\n",
                row.data, row.type, row.steps, row.isovalue, row.active, cell_text(row.delta_ids),
                cell_text(row.scan_us), cell_text(row.tbon_us), cell_text(row.flying_edges_us),
                cell_text(row.flying_edges_normals_us), cell_text(row.memcpy_us),
                results.details[i].queries, "structure", "", "bytes", "% raw", "% +vol", "% FP",
                "FN", "ids us", "full us", "whole us", "sweep ms", "Mcs/s");
        text += line_of(row, results.details[i]);
        before = &row;
    }
    return text;
}

} // namespace isochron::bench
