// Measures all structures on one series.
#include "tests/bench/measures/measure.h"

#include "index/scan/scan.h"
#include "index/search/id_sort.h"
#include "tests/bench/measures/errors.h"
#include "tests/bench/measures/isovalues.h"
#include "tests/bench/measures/timing.h"
#include "tests/bench/rivals/flying_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <numeric>

namespace isochron::bench {

namespace {

using index::CellId;
using index::CellSet;
using index::Query;
using index::StepValues;

/// Most cells times steps for which the paper's structure is built, with about 30 bytes for each.
constexpr double kMostThiCellSteps = 150e6;

/// The correct result at the isovalue of the times.
struct Surface {
    std::vector<Ids> active; ///< active cells of each step, ascending
    double mean_active = 0;
    std::optional<double> mean_change; ///< mean number of added and removed cells per step

    Surface(const StepValues& values, double isovalue) : active(values.steps) {
        for (std::uint32_t step = 0; step < values.steps; ++step) {
            index::scan(values, {index::Instant(step), isovalue}, active[step]);
            mean_active += static_cast<double>(active[step].size());
        }
        mean_active /= static_cast<double>(values.steps);
        if (values.steps < 2)
            return;
        Ids changed;
        for (std::size_t step = 1; step < values.steps; ++step)
            std::set_symmetric_difference(active[step - 1].begin(), active[step - 1].end(),
                                          active[step].begin(), active[step].end(),
                                          std::back_inserter(changed));
        mean_change = static_cast<double>(changed.size()) / static_cast<double>(values.steps - 1);
    }
};

/// Keeps the compiler from removing a copy whose result is not used.
void keep(const void* memory) {
    asm volatile("" : : "r"(memory) : "memory");
}

/// The operations that every structure is compared with, in the order of the columns.
std::vector<Operation> comparisons(const StepValues& values, double isovalue, const Structure& tbon,
                                   FlyingEdges& peer, const Surface& surface) {
    std::vector<Operation> all;
    all.push_back([&values, isovalue, out = Ids()](std::uint32_t step) mutable {
        out.clear();
        index::scan(values, {index::Instant(step), isovalue}, out);
    });
    all.push_back([&tbon, isovalue, out = Ids()](std::uint32_t step) mutable {
        tbon.ids({index::Instant(step), isovalue}, out);
    });
    for (const bool normals : {false, true})
        all.push_back([&peer, isovalue, normals](std::uint32_t step) {
            peer.contour({index::Instant(step), isovalue}, normals);
        });
    all.push_back([&surface, copy = Ids()](std::uint32_t step) mutable {
        const Ids& active = surface.active[step];
        if (copy.size() < active.size())
            copy.resize(active.size());
        std::memcpy(copy.data(), active.data(), active.size() * sizeof(CellId));
        keep(copy.data());
    });
    return all;
}

/// Makes a set as the program does: sorted, tested if the ids are candidates, and shaded.
void make_set(const StepValues& values, const Structure& structure, const Query& query,
              CellSet& set) {
    structure.ids(query, set.ids);
    index::sort_ids(set.ids, values.grid.cell_count());
    if (structure.candidates)
        index::keep_active(values, query, set.ids);
    index::shade_cells(values, set);
}

/// The times of a structure's own searches, and of the comparisons.
void time_searches(const StepValues& values, const Structure& structure,
                   const std::vector<Operation>& compared, unsigned rounds, Row& row) {
    const double isovalue = row.isovalue;
    const auto steps = static_cast<std::uint32_t>(values.steps);
    // The next step; for the last step the one before it.
    const auto neighbor = [steps](std::uint32_t step) {
        return step + 1 < steps ? step + 1 : step - 1;
    };
    std::vector<Operation> operations = compared;
    operations.push_back([&, out = Ids()](std::uint32_t step) mutable {
        structure.ids({index::Instant(step), isovalue}, out);
    });
    operations.push_back([&](std::uint32_t step) {
        CellSet set;
        set.query = {index::Instant(step), isovalue};
        if (structure.full)
            structure.full(set.query, set);
        else
            make_set(values, structure, set.query, set);
    });
    std::optional<std::size_t> follow;
    if (structure.follow && steps > 1) {
        follow = operations.size();
        operations.push_back([&](std::uint32_t step) { // there and back, so that it can be repeated
            structure.follow({index::Instant(neighbor(step)), isovalue});
            structure.follow({index::Instant(step), isovalue});
        });
    }

    const std::vector<double> seconds = time_in_turn(operations, steps, rounds);
    const auto microseconds = [&](std::size_t operation) { return 1e6 * seconds[operation]; };
    const std::array columns{
        &row.scan_us,   &row.tbon_us,       &row.flying_edges_us, &row.flying_edges_normals_us,
        &row.memcpy_us, &row.search_ids_us, &row.search_full_us};
    for (std::size_t i = 0; i < columns.size(); ++i)
        *columns[i] = microseconds(i);
    if (follow)
        row.incremental_full_us = microseconds(*follow) / 2;
}

double sweep_seconds(const StepValues& values, const Structure& structure, double isovalue,
                     unsigned rounds) {
    return time_sweep(
        [&, out = Ids()](std::uint32_t step) mutable {
            if (structure.follow) {
                structure.follow({index::Instant(step), isovalue});
                return;
            }
            structure.ids({index::Instant(step), isovalue}, out);
        },
        static_cast<std::uint32_t>(values.steps), rounds);
}

double percent(double part, double whole) {
    return whole > 0 ? 100 * part / whole : 0;
}

} // namespace

Results measure(const std::shared_ptr<const index::IndexFile>& file, const MeasureOptions& options,
                const index::Progress& progress) {
    const StepValues& values = file->values();
    const double cell_steps =
        static_cast<double>(values.grid.cell_count()) * static_cast<double>(values.steps);
    const double raw_bytes = 24 * cell_steps;
    const double volume_bytes =
        static_cast<double>(values.grid.vertex_count() * size_of(values.type) * values.steps);
    const std::vector<double> isovalues = quantile_isovalues(values, options.error_isovalues);
    const std::vector<double> isovalue{options.isovalue};
    const Surface surface(values, options.isovalue);
    const auto peer = flying_edges(values);
    const Structure tbon = build_tbon(file, options.structures.threads);
    const std::vector<Operation> compared =
        comparisons(values, options.isovalue, tbon, *peer, surface);

    StructureOptions wanted = options.structures;
    if (cell_steps > kMostThiCellSteps)
        wanted.lattices.clear();
    Results results;
    for (Recipe& next : structures_of(file, tbon, wanted)) {
        // What only this recipe and those before it share is freed when it is done.
        const Recipe recipe = std::move(next);
        const auto phase = [&](const char* what) -> std::function<void(double)> {
            return [&, what](double fraction) {
                progress(fmt::format("{} {} x {}, {}: {}", options.data,
                                     index::name_of(values.type), values.steps, recipe.what, what),
                         fraction);
            };
        };
        const Structure structure =
            recipe.build([building = phase("building")](std::string_view, double fraction) {
                building(fraction);
            });
        Row row;
        row.data = options.data;
        row.type = index::name_of(values.type);
        row.steps = values.steps;
        row.structure = structure.name;
        if (structure.thi) {
            row.l = structure.thi->lattice;
            row.max_variation = structure.thi->max_variation;
        }
        row.threads = structure.build_threads;
        row.isovalue = options.isovalue;
        row.active = surface.mean_active;
        row.delta_ids = surface.mean_change;
        row.bytes = structure.bytes;
        row.percent_of_raw = percent(static_cast<double>(structure.bytes), raw_bytes);
        row.percent_with_volume =
            percent(static_cast<double>(structure.bytes) + volume_bytes, raw_bytes);
        if (structure.build_seconds > 0)
            row.build_mcs_per_s = 1e-6 * cell_steps / structure.build_seconds;

        const ErrorCount errors =
            count_errors(values, structure, isovalues, phase("counting errors"));
        row.false_positives = errors.false_positives;
        row.false_negatives = errors.false_negatives;
        const ErrorCount here = count_errors(values, structure, isovalue, [](double) {});
        phase("timing")(0);
        time_searches(values, structure, compared, options.rounds, row);
        row.sweep_ms = 1e3 * sweep_seconds(values, structure, row.isovalue, options.rounds);
        results.rows.push_back(row);
        results.details.push_back(
            {.queries = values.steps * isovalues.size(),
             .active = errors.active,
             .percent_at_isovalue = percent(static_cast<double>(here.false_positives),
                                            static_cast<double>(here.active)),
             .entries = structure.entries,
             .normal_error_mean = {},
             .normal_error_p99 = {}});
        if (structure.normal_error) {
            const NormalError error = structure.normal_error(row.isovalue);
            results.details.back().normal_error_mean = error.mean_degrees;
            results.details.back().normal_error_p99 = error.p99_degrees;
        }
    }
    return results;
}

} // namespace isochron::bench
