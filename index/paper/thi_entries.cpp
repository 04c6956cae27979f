// Finds the entries of a THI tree: the cells at each time node, with their extremes.
#include "index/paper/thi_entries.h"

#include "index/error.h"
#include "index/paper/lattice.h"
#include "index/paper/temporal_variation.h"
#include "index/paper/time_tree.h"
#include "index/system/parallel.h"
#include "index/volume/cell_extremes.h"

#include <algorithm>

namespace isochron::index {
namespace {

/// Divides the cells into batches of whole rows, so small that a batch's extremes at all steps stay
/// in the cache.
class Batches {
  public:
    explicit Batches(const StepValues& values) : values_(values) {
        const auto [x, y, z] = values.grid.cells();
        constexpr std::size_t kBytes = 1 << 20;
        const std::size_t row_bytes = x * values.steps * 2 * sizeof(OrderKey);
        row_cells_ = x;
        rows_ = std::size_t{y} * z;
        rows_per_batch_ = std::clamp<std::size_t>(kBytes / row_bytes, 1, rows_);
    }

    std::size_t count() const { return (rows_ + rows_per_batch_ - 1) / rows_per_batch_; }
    CellId first_cell(std::size_t batch) const {
        return static_cast<CellId>(batch * rows_per_batch_ * row_cells_);
    }

    /// Extremes of a batch, step after step.
    struct Extremes {
        std::size_t cells = 0;
        std::vector<OrderKey> low, high; ///< [step][cell]
    };
    void extremes(std::size_t batch, CellExtremes& compute, Extremes& out) const {
        const std::size_t first_row = batch * rows_per_batch_;
        const std::size_t rows = std::min(rows_per_batch_, rows_ - first_row);
        const std::uint32_t y_rows = values_.grid.cells()[1];
        out.cells = rows * row_cells_;
        out.low.resize(out.cells * values_.steps);
        out.high.resize(out.low.size());
        std::size_t at = 0;
        for (std::size_t step = 0; step < values_.steps; ++step)
            for (std::size_t row = first_row; row < first_row + rows; ++row, at += row_cells_)
                compute.row(step, static_cast<std::uint32_t>(row % y_rows),
                            static_cast<std::uint32_t>(row / y_rows),
                            std::span(out.low).subspan(at, row_cells_),
                            std::span(out.high).subspan(at, row_cells_));
    }

  private:
    const StepValues& values_;
    std::size_t row_cells_, rows_, rows_per_batch_;
};

/// The work space of a thread, kept from batch to batch.
struct Worker {
    explicit Worker(const StepValues& values) : compute(values) {}
    CellExtremes compute;
    Batches::Extremes extremes;
};

std::vector<OrderKey> find_lattice(const Batches& batches, std::vector<Worker>& workers,
                                   std::uint32_t lattice,
                                   const std::function<void(double)>& progress) {
    DistinctKeys distinct;
    const auto threads = static_cast<unsigned>(workers.size());
    parallel_for(
        batches.count(), threads,
        [&](std::size_t batch, unsigned number) {
            auto& [compute, extremes] = workers[number];
            batches.extremes(batch, compute, extremes);
            for (std::size_t i = 0; i < extremes.low.size(); ++i)
                if (extremes.low[i] <= extremes.high[i]) {
                    distinct.insert(extremes.low[i]);
                    distinct.insert(extremes.high[i]);
                }
        },
        progress);
    return lattice_lines(distinct, lattice);
}

/// Finds all entries, one set for each worker: by time node, in blocks.
std::vector<std::vector<std::deque<Interval>>>
classify(const Batches& batches, std::vector<Worker>& workers, std::span<const OrderKey> lines,
         std::uint32_t steps, std::uint32_t max_variation,
         const std::function<void(double)>& progress) {
    std::vector<std::vector<std::deque<Interval>>> entries(workers.size());
    std::vector<TemporalVariation> variations;
    for (auto& of_worker : entries) {
        of_worker.resize(TimeNode::count(steps));
        variations.emplace_back(lines, steps, max_variation);
    }
    parallel_for(
        batches.count(), static_cast<unsigned>(workers.size()),
        [&](std::size_t batch, unsigned number) {
            auto& [compute, extremes] = workers[number];
            batches.extremes(batch, compute, extremes);
            const CellId first = batches.first_cell(batch);
            for (std::size_t cell = 0; cell < extremes.cells; ++cell)
                variations[number].visit_nodes(
                    extremes.low.data() + cell, extremes.high.data() + cell, extremes.cells,
                    [&](std::uint32_t node, OrderKey low, OrderKey high) {
                        entries[number][node].push_back(
                            {low, high, first + static_cast<CellId>(cell)});
                    });
        },
        progress);
    return entries;
}

void check(const StepValues& values, const ThiOptions& options) {
    const auto require = [](bool holds, std::string_view what, std::uint64_t got) {
        if (!holds)
            throw Error("THI tree: {}, got {}", what, got);
    };
    require(options.lattice >= 1 && options.lattice <= 4096, "lattice from 1 to 4096 expected",
            options.lattice);
    require(options.max_variation >= 1 && options.max_variation <= 64,
            "max variation from 1 to 64 expected", options.max_variation);
    require(values.steps >= 1 && values.steps < 1u << 31, "1 to 2^31 - 1 steps expected",
            values.steps);
    require(values.grid.cell_count() >= 1 && values.grid.cell_count() < IntervalNode::kNone,
            "1 to 2^32 - 2 cells expected", values.grid.cell_count());
}

} // namespace

ThiEntries::ThiEntries(const StepValues& values, const ThiOptions& options,
                       const Progress& progress, unsigned threads)
    : options_(options), steps_(static_cast<std::uint32_t>(values.steps)) {
    check(values, options);
    const Batches batches(values);
    const std::size_t worker_count = std::min<std::size_t>(thread_count(threads), batches.count());
    std::vector<Worker> workers(worker_count, Worker(values));
    nodes_ = TimeNode::count(steps_);
    lines_ =
        find_lattice(batches, workers, options.lattice, phase_of(progress, "dividing span space"));
    by_worker_ = classify(batches, workers, lines_, steps_, options.max_variation,
                          phase_of(progress, "finding coherence"));
}

std::uint64_t ThiEntries::count(std::size_t node) const {
    std::uint64_t count = 0;
    for (const ByNode& of_worker : by_worker_)
        count += of_worker[node].size();
    return count;
}

std::vector<Interval> ThiEntries::take(std::size_t node) {
    std::vector<Interval> all;
    all.reserve(count(node));
    for (ByNode& of_worker : by_worker_) {
        all.insert(all.end(), of_worker[node].begin(), of_worker[node].end());
        std::deque<Interval>().swap(of_worker[node]);
    }
    return all;
}

} // namespace isochron::index
