// The tiers of an index, as structures for the benchmark.
#include "index/cells/unit_builder.h"
#include "index/file/sections/tiers.h"
#include "index/scan/bricks.h"
#include "index/search/cell_change.h"
#include "index/volume/stretches.h"
#include "tests/bench/measures/stopwatch.h"
#include "tests/bench/measures/structures.h"

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace isochron::bench {
namespace {

using index::IndexFile;
using index::Query;
using index::StepValues;
using index::Tier;
using FilePtr = std::shared_ptr<const IndexFile>;

/// Bytes of the file without the volume, its levels of detail, and the tiers in `others`.
std::uint64_t bytes_without(const IndexFile& file, std::initializer_list<Tier> others) {
    std::uint64_t bytes =
        file.stats().file_bytes - file.stats().volume_bytes - file.stats().detail_bytes;
    for (const Tier tier : others)
        bytes -= file.stats().bytes_of(tier);
    return bytes;
}

/// Time to build the bricks of all steps again, on one thread.
double seconds_for_bricks(const IndexFile& file) {
    const StepValues& values = file.values();
    std::vector<std::uint8_t> bricks(index::BrickGrid(values.grid).bytes_per_step());
    const Stopwatch watch;
    for (std::size_t step = 0; step < values.steps; ++step)
        index::build_bricks(values, *file.chunks().levels(static_cast<std::uint32_t>(step)), step,
                            bricks);
    return watch.seconds();
}

/// Seconds for the cells of all stretches and epochs, and their deltas.
double seconds_for_cells(const IndexFile& file, bool deltas, const index::Progress& progress) {
    const StepValues& values = file.values();
    const std::uint32_t stretches = index::Stretches(values.grid).count();
    index::UnitBuilder builder(values, file.levels());
    index::UnitBytes unit;
    const Stopwatch watch;
    for (std::uint32_t epoch = 0; epoch < index::epoch_count(values.steps); ++epoch)
        for (std::uint32_t stretch = 0; stretch < stretches; ++stretch) {
            if (progress)
                progress("building", static_cast<double>(stretch) / stretches);
            builder.build(stretch, epoch, deltas, unit);
        }
    return watch.seconds();
}

Recipe bricks_of(const FilePtr& file) {
    return {"bricks", [file](const index::Progress&) {
                Structure structure;
                structure.name = "bricks";
                structure.bytes = bytes_without(*file, {Tier::cells, Tier::deltas, Tier::tree});
                structure.build_seconds = seconds_for_bricks(*file);
                structure.ids = [file](const Query& query, Ids& out) {
                    out.clear();
                    const index::LoadedStep step = file->load(query.step);
                    index::search_bricks(step.values, *file->chunks().levels(query.step),
                                         step.bricks, query, out);
                };
                return structure;
            }};
}

/// A search of the cell tier, with the memory for its runs.
struct CellSearch {
    explicit CellSearch(const FilePtr& of) : file(of), changes(of) {}

    const std::vector<index::IdRun>& runs(const Query& query) {
        certain.clear();
        ambiguous.clear();
        if (const auto cut = file->levels().cut(file->info().scaling, query.isovalue))
            file->cells()->search(query.step, *cut, certain, ambiguous);
        return certain;
    }

    FilePtr file;
    std::vector<index::IdRun> certain, ambiguous;
    index::ChangeSearch changes;
    Ids all;
};

/// Only for lossless levels, with which no run is ambiguous.
Recipe cells_of(const FilePtr& file, bool deltas) {
    const std::string name = deltas ? "cells+deltas" : "cells";
    return {name, [=](const index::Progress& progress) {
                const auto search = std::make_shared<CellSearch>(file);
                Structure structure;
                structure.name = name;
                structure.bytes = deltas ? bytes_without(*file, {Tier::tree})
                                         : bytes_without(*file, {Tier::deltas, Tier::tree});
                structure.entries = file->stats().cell_entries;
                structure.build_seconds = seconds_for_cells(*file, deltas, progress);
                structure.runs = [search](const Query& query) {
                    return search->runs(query).size();
                };
                structure.ids = [search](const Query& query, Ids& out) {
                    index::assign_ids(search->runs(query), out);
                };
                structure.follow = [search](const Query& query) {
                    index::assign_ids(search->runs(query), search->all);
                    return search->all.size();
                };
                if (deltas)
                    structure.change = [search](const Query& from, const Query& to) {
                        const index::CellChange change = search->changes(from, to);
                        return change.added.size() + change.removed.size();
                    };
                return structure;
            }};
}

} // namespace

std::vector<Recipe> tiers_of(const FilePtr& file) {
    std::vector<Recipe> all;
    if (file->plan().tiers.has(Tier::bricks))
        all.push_back(bricks_of(file));
    if (file->cells() && file->levels().lossless()) {
        all.push_back(cells_of(file, false));
        if (file->cells()->has_deltas())
            all.push_back(cells_of(file, true));
    }
    return all;
}

} // namespace isochron::bench
