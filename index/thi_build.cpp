// Building of the THI tree: lattice, then the time nodes of every cell, then the lists of each
// node.
#include "index/cell_extremes.h"
#include "index/error.h"
#include "index/lattice.h"
#include "index/parallel.h"
#include "index/temporal_variation.h"
#include "index/thi_layout.h"
#include "index/thi_tree.h"
#include "index/time_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <deque>

namespace isochron::index {
namespace {

/// The cells in batches of whole rows, small enough that a batch's extremes at all steps stay in
/// the cache.
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

/// What a thread keeps from batch to batch.
struct Worker {
    explicit Worker(const StepValues& values) : compute(values) {}
    CellExtremes compute;
    Batches::Extremes extremes;
};

/// Entries of each time node, in no particular order; in small blocks, for there are many.
using Entries = std::vector<std::deque<Interval>>;

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

/// One set of entries for each worker.
std::vector<Entries> classify(const Batches& batches, std::vector<Worker>& workers,
                              std::span<const OrderKey> lines, std::uint32_t steps,
                              std::uint32_t max_variation,
                              const std::function<void(double)>& progress) {
    std::vector<Entries> entries(workers.size());
    std::vector<TemporalVariation> variations;
    for (Entries& of_worker : entries) {
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

/// Takes the entries of one time node out of all workers' hands.
std::vector<Interval> gather(std::vector<Entries>& entries, std::size_t node) {
    std::vector<Interval> all;
    std::size_t count = 0;
    for (const Entries& of_worker : entries)
        count += of_worker[node].size();
    all.reserve(count);
    for (Entries& of_worker : entries) {
        all.insert(all.end(), of_worker[node].begin(), of_worker[node].end());
        std::deque<Interval>().swap(of_worker[node]);
    }
    return all;
}

/// Fills the parts of one time node: the rows' lists, then an interval tree for each element on
/// the diagonal.
void organise(std::vector<Interval> unsorted, std::span<const OrderKey> lines,
              const Lists<Writable>& lists, std::span<std::uint32_t> row_starts,
              std::span<std::uint32_t> roots, std::vector<IntervalNode>& nodes) {
    const std::size_t elements = lines.size();
    // Counting sort into one group for each row and one for each diagonal element.
    const auto group_of = [&](const Interval& entry) {
        const std::uint32_t column = element_of(lines, entry.low);
        const std::uint32_t row = element_near(lines, entry.high, column);
        return column == row ? elements + row : row;
    };
    std::vector<std::size_t> starts(2 * elements + 2);
    for (const Interval& entry : unsorted)
        ++starts[group_of(entry) + 2];
    for (std::size_t group = 2; group < starts.size(); ++group)
        starts[group] += starts[group - 1];
    std::vector<Interval> grouped(unsorted.size());
    for (const Interval& entry : unsorted)
        grouped[starts[group_of(entry) + 1]++] = entry;
    unsorted = {};

    for (std::size_t group = 0; group < 2 * elements; ++group) {
        const std::size_t count = starts[group + 1] - starts[group];
        const auto entries = std::span(grouped).subspan(starts[group], count);
        const auto begin = static_cast<std::uint32_t>(starts[group]);
        if (group < elements)
            write_lists(entries, lists.part(begin, count));
        else
            roots[group - elements] =
                build_interval_tree(entries, nodes, lists.part(begin, count), begin);
    }
    for (std::size_t row = 0; row <= elements; ++row)
        row_starts[row] = static_cast<std::uint32_t>(starts[row]);
}

void check(const StepValues& values, const ThiOptions& options) {
    const auto require = [](bool holds, std::string_view what, std::uint64_t got) {
        if (!holds)
            throw Error(fmt::format("THI tree: {}, got {}", what, got));
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

std::vector<std::byte> build_thi_tree(const StepValues& values, const ThiOptions& options,
                                      const Progress& progress, unsigned threads) {
    check(values, options);
    const auto phase = [&](std::string_view name) -> std::function<void(double)> {
        if (!progress)
            return nullptr;
        return [&progress, name](double fraction) { progress(name, fraction); };
    };
    const Batches batches(values);
    const std::size_t worker_count = std::min<std::size_t>(thread_count(threads), batches.count());
    std::vector<Worker> workers(worker_count, Worker(values));
    const auto steps = static_cast<std::uint32_t>(values.steps);

    const std::vector<OrderKey> lines =
        find_lattice(batches, workers, options.lattice, phase("dividing span space"));
    std::vector<Entries> entries =
        classify(batches, workers, lines, steps, options.max_variation, phase("finding coherence"));
    workers.clear();

    ThiHeader header;
    header.steps = steps;
    header.lattice = options.lattice;
    header.max_variation = options.max_variation;
    header.elements = static_cast<std::uint32_t>(lines.size());
    const std::size_t nodes = TimeNode::count(steps);
    std::vector<ThiNodeStart> node_starts(nodes + 1);
    for (std::size_t node = 0; node < nodes; ++node) {
        node_starts[node].entry = header.entries;
        for (const Entries& of_worker : entries)
            header.entries += of_worker[node].size();
    }
    node_starts[nodes].entry = header.entries;

    // The interval nodes, whose number is known at last, are the last part.
    std::vector<std::byte> bytes(thi_offsets(header, SIZE_MAX).back());
    const ThiParts<Writable> parts = thi_parts(header, std::span(bytes));
    std::vector<std::vector<IntervalNode>> interval_nodes(nodes);
    parallel_for(
        nodes, thread_count(threads),
        [&](std::size_t node, unsigned) {
            const std::uint64_t first = node_starts[node].entry;
            organise(gather(entries, node), lines,
                     parts.lists.part(first, node_starts[node + 1].entry - first),
                     parts.row_starts.subspan(node * (lines.size() + 1), lines.size() + 1),
                     parts.roots.subspan(node * lines.size(), lines.size()), interval_nodes[node]);
        },
        phase("sorting lists"));

    for (std::size_t node = 0; node < nodes; ++node) {
        node_starts[node].interval_node = header.interval_nodes;
        header.interval_nodes += interval_nodes[node].size();
    }
    node_starts[nodes].interval_node = header.interval_nodes;
    std::copy(lines.begin(), lines.end(), parts.lines.begin());
    std::copy(node_starts.begin(), node_starts.end(), parts.node_starts.begin());
    bytes.resize(thi_offsets(header, SIZE_MAX).back());
    std::memcpy(bytes.data(), &header, sizeof header);
    auto next = thi_parts(header, std::span(bytes)).interval_nodes.begin();
    for (const auto& of_node : interval_nodes)
        next = std::copy(of_node.begin(), of_node.end(), next);
    return bytes;
}

} // namespace isochron::index
