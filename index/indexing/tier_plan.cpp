// Chooses the tiers for a series.
#include "index/indexing/tier_plan.h"

#include "index/cells/stretch_ranks.h"
#include "index/cells/unit_builder.h"
#include "index/error.h"
#include "index/volume/stretches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::index {
namespace {

constexpr std::uint32_t kSampledStretches = 8, kSampledSteps = 17;
/// Up to this many bytes of values the size of an index does not matter, and it has all that makes a
/// search faster.
constexpr std::uint64_t kTinySeries = 128 << 10;
/// Steps up to this size are read as a whole anyway; in larger ones bricks read less.
constexpr std::uint64_t kSmallStep = 4 << 20;
/// In larger series cells pay if merging in time leaves at most this fraction of the entries: a
/// search reads its entries instead of the values around them.
constexpr double kPayingCoherence = 0.8;
/// With cells, an index may take at most this many bytes for each byte of values: cells shorten the
/// search alone, which is a small part of the way to a picture.
constexpr double kPayingBytes = 1.2;
constexpr std::uint32_t kMergedSteps = 64; ///< steps that are looked at to estimate that
/// In larger steps cells never pay: at 512^3, with the greatest coherence in time, they took three
/// times the bytes, and a search from disk took 5 to 16 times as long as with bricks.
constexpr std::uint64_t kLargestStep = 64 << 20;

/// Number of levels that are in exactly one of two half-open intervals.
std::uint32_t difference(std::uint8_t a_low, std::uint8_t a_high, std::uint8_t b_low,
                         std::uint8_t b_high) {
    const auto length = [](int low, int high) {
        return static_cast<std::uint32_t>(std::max(high - low, 0));
    };
    const std::uint32_t common = length(std::max(a_low, b_low), std::min(a_high, b_high));
    return length(a_low, a_high) + length(b_low, b_high) - 2 * common;
}

} // namespace

double churn(const StepValues& values, const LevelMap& levels) {
    const Stretches stretches(values.grid);
    const std::uint32_t sampled = std::min(kSampledStretches, stretches.count());
    const auto steps =
        static_cast<std::uint32_t>(std::min<std::size_t>(kSampledSteps, values.steps));
    // From the middle of the series, since often little moves at the beginning.
    const auto first = static_cast<std::uint32_t>((values.steps - steps) / 2);
    StretchRanks ranks(values, levels);
    std::uint64_t changed = 0, active = 0;
    for (std::uint32_t i = 0; i < sampled; ++i) {
        const std::uint32_t stretch = static_cast<std::uint32_t>((std::uint64_t{2} * i + 1) *
                                                                 stretches.count() / (2 * sampled));
        ranks.compute(stretch, first, steps);
        for (std::uint32_t t = 0; t + 1 < steps; ++t) {
            const StretchRanks::Extremes now = ranks.at(t), next = ranks.at(t + 1);
            for (std::uint32_t cell = 0; cell < ranks.cells(); ++cell) {
                const std::uint8_t low = now.low[cell], high = now.high[cell];
                changed += difference(low, high, next.low[cell], next.high[cell]);
                active += high > low ? high - low : 0;
            }
        }
    }
    if (steps < 2)
        return 0;
    return active ? static_cast<double>(changed) / static_cast<double>(active)
                  : std::numeric_limits<double>::infinity();
}

CellCost cost_of_cells(const StepValues& values, const LevelMap& levels) {
    const Stretches stretches(values.grid);
    const std::uint32_t sampled = std::min(kSampledStretches, stretches.count());
    StepValues window = values;
    window.steps = std::min<std::size_t>(kMergedSteps, values.steps);
    window.first += (values.steps - window.steps) / 2 * values.stride;
    UnitBuilder builder(window, levels);
    UnitBytes unit;
    std::uint64_t entries = 0, cell_bytes = 0, delta_bytes = 0, cell_steps = 0;
    for (std::uint32_t i = 0; i < sampled; ++i) {
        const auto stretch = static_cast<std::uint32_t>((std::uint64_t{2} * i + 1) *
                                                        stretches.count() / (2 * sampled));
        builder.build(stretch, 0, true, unit);
        entries += unit.entries;
        cell_bytes += unit.cells.size();
        delta_bytes += unit.deltas.size();
        cell_steps += stretches.cells(stretch) * window.steps;
    }
    const auto of = static_cast<double>(cell_steps);
    const double value_bytes = of * static_cast<double>(size_of(values.type));
    return {static_cast<double>(entries) / of, static_cast<double>(cell_bytes) / value_bytes,
            static_cast<double>(delta_bytes) / value_bytes};
}

bool cells_may_pay(const SeriesInfo& info) {
    return info.step_bytes() <= kLargestStep && info.grid.cells()[0] <= Stretches::kMaxCells;
}

void check_tiers(const Grid& grid, const TierSet& asked) {
    if (asked.has(Tier::cells) && grid.cells()[0] > Stretches::kMaxCells)
        throw Error(fmt::format("rows of {} cells, expected at most {} for the tier cells",
                                grid.cells()[0], Stretches::kMaxCells));
    if (has_wide_ids(grid) && (asked.has(Tier::cells) || asked.has(Tier::tree)))
        throw Error(fmt::format("{} cells, expected fewer than 2^32 for the tiers cells and tree",
                                grid.cell_count()));
    if (asked.has(Tier::deltas) && !asked.has(Tier::cells))
        throw Error("the tier deltas needs the tier cells");
}

TierPlan plan_tiers(const StepValues& values, const LevelMap& levels,
                    const std::optional<TierSet>& asked, double others) {
    const bool fits = values.grid.cells()[0] <= Stretches::kMaxCells;
    if (asked) {
        check_tiers(values.grid, *asked);
        if (asked->has(Tier::deltas) && !levels.lossless())
            throw Error("the tier deltas needs at most 256 distinct values in the series");
        return {*asked, {"as asked for"}, true};
    }
    TierPlan plan;
    const auto add = [&](Tier tier, const std::string& reason) {
        plan.tiers = plan.tiers.with(tier);
        plan.reasons.push_back(
            fmt::format("{}: {}", kTierNames[static_cast<std::size_t>(tier)], reason));
    };
    const auto leave_out = [&](std::string_view tier, const std::string& reason) {
        plan.reasons.push_back(fmt::format("no {}: {}", tier, reason));
    };
    add(Tier::bricks, "exact with the volume, for every type and size");
    if (!levels.lossless()) {
        leave_out("cells", "more than 256 distinct values, so that entries do not merge in time");
        return plan;
    }
    if (!fits) {
        leave_out("cells", fmt::format("rows of {} cells, at most {} can be indexed",
                                       values.grid.cells()[0], Stretches::kMaxCells));
        return plan;
    }
    const std::uint64_t step_bytes = values.grid.vertex_count() * size_of(values.type);
    if (step_bytes > kLargestStep) {
        leave_out("cells",
                  fmt::format("a step has {:.0f} MiB: of more than {} MiB bricks and the values "
                              "around them are fewer bytes to read",
                              static_cast<double>(step_bytes) / (1 << 20), kLargestStep >> 20));
        return plan;
    }
    const CellCost cost = cost_of_cells(values, levels);
    const std::string figures = fmt::format(
        "{:.2f} entries for a cell and step, {:.2f} bytes for each byte of values beside {:.2f} of "
        "all else",
        cost.entries, cost.cell_bytes, others);
    const bool merges = step_bytes <= kSmallStep || cost.entries <= kPayingCoherence;
    const bool tiny = step_bytes * values.steps <= kTinySeries;
    if (!tiny && (!merges || cost.cell_bytes + others > kPayingBytes)) {
        leave_out("cells",
                  fmt::format("{}; more than {} do not pay, as cells shorten the search alone; "
                              "--tiers bricks,cells makes them all the same",
                              figures,
                              merges ? fmt::format("{} bytes in all", kPayingBytes)
                                     : fmt::format("{} entries", kPayingCoherence)));
        return plan;
    }
    plan.reasons.push_back(
        fmt::format("cells pay: {}", tiny ? std::string("the series is tiny") : figures));
    add(Tier::cells,
        fmt::format("at most {} levels, none of them shared by two values", levels.levels()));
    const double changing = churn(values, levels);
    if (values.steps < 2)
        leave_out("deltas", "one step");
    else if (tiny && changing < 1)
        add(Tier::deltas, fmt::format("a step changes {:.0f} % of the active cells, and the series "
                                      "is tiny",
                                      100 * changing));
    else
        leave_out("deltas",
                  fmt::format("they would take {:.2f} bytes for each byte of values, and only "
                              "`isochron change` is faster with them (a step changes {:.0f} % of "
                              "the active cells); --tiers bricks,cells,deltas makes them",
                              cost.delta_bytes, std::isfinite(changing) ? 100 * changing : 0));
    return plan;
}

} // namespace isochron::index
