// The search structures that are measured.
#include "tests/bench/measures/structures.h"

#include "index/paper/thi_tree.h"
#include "index/scan/bricks.h"
#include "index/scan/scan.h"
#include "index/system/parallel.h"
#include "index/volume/order_key.h"
#include "tests/bench/measures/stopwatch.h"
#include "tests/bench/rivals/tbon.h"
#include "tests/bench/rivals/thi_variants.h"

#include <fmt/format.h>

#include <array>

namespace isochron::bench {

namespace {

using index::IndexFile;
using index::Query;
using FilePtr = std::shared_ptr<const IndexFile>;

Recipe scan_of(const FilePtr& file) {
    return {"scan", [file](const index::Progress&) {
                Structure structure;
                structure.name = "scan";
                structure.ids = [file](const Query& query, Ids& out) {
                    out.clear();
                    index::scan(file->values(), query, out);
                };
                structure.full = [file](const Query& query, index::CellSet& set) {
                    index::scan(file->values(), query, set.ids); // already in order
                    index::shade_cells(file->values(), set);
                };
                return structure;
            }};
}

/// Bytes of the file without the volume, its levels of detail, and the tree.
std::uint64_t bytes_of_bricks(const index::IndexStats& stats) {
    return stats.file_bytes - stats.volume_bytes - stats.detail_bytes - stats.tree_bytes -
           stats.unused_bytes;
}

/// Time to build the bricks of all steps again, on one thread.
double seconds_for_bricks(const IndexFile& file) {
    const index::StepValues& values = file.values();
    std::vector<std::uint8_t> bricks(index::BrickGrid(values.grid).bytes_per_step());
    const Stopwatch watch;
    for (std::size_t step = 0; step < values.steps; ++step)
        index::build_bricks(values, *file.chunks().levels(static_cast<std::uint32_t>(step)), step,
                            bricks);
    return watch.seconds();
}

Recipe bricks_of(const FilePtr& file) {
    return {"bricks", [file](const index::Progress&) {
                Structure structure;
                structure.name = "bricks";
                structure.bytes = bytes_of_bricks(file->stats());
                structure.build_seconds = seconds_for_bricks(*file);
                structure.ids = [file](const Query& query, Ids& out) {
                    out.clear();
                    const index::LoadedStep step = file->load(query.instant.step);
                    index::search_bricks(step.values, *file->chunks().levels(query.instant.step),
                                         step.bricks, query, out);
                };
                return structure;
            }};
}

std::string name_with(const std::string& name, const index::ThiOptions& options) {
    return fmt::format("{} L {}, MaxVariation {}", name, options.lattice, options.max_variation);
}

/// A tree together with its bytes.
struct OwnThiTree {
    explicit OwnThiTree(std::vector<std::byte> built) : bytes(std::move(built)), tree(bytes) {}
    OwnThiTree(const OwnThiTree&) = delete;
    OwnThiTree& operator=(const OwnThiTree&) = delete;
    std::vector<std::byte> bytes;
    index::ThiTree tree;
    index::ThiTree::Cursor cursor;
};

/// The entries that the tree and its variants have in common, found once for all of them: their
/// time counts for each.
class CommonEntries {
  public:
    CommonEntries(FilePtr file, const index::ThiOptions& options, unsigned threads)
        : file_(std::move(file)), options_(options), threads_(threads) {}

    const index::ThiEntries& get(const index::Progress& progress) {
        if (!entries_) {
            const Stopwatch watch(Stopwatch::Of::all_threads);
            entries_.emplace(file_->values(), options_, progress, threads_);
            seconds_ = watch.seconds();
        }
        return *entries_;
    }
    double seconds() const { return seconds_; } ///< processor time of all threads, after `get`
    const index::ThiOptions& options() const { return options_; }
    unsigned threads() const { return threads_; }

  private:
    FilePtr file_;
    index::ThiOptions options_;
    unsigned threads_;
    std::optional<index::ThiEntries> entries_;
    double seconds_ = 0;
};
using CommonEntriesPtr = std::shared_ptr<CommonEntries>;

/// What the tree and its variants have in common as structures, once they are built in that time.
Structure built_of(const char* name, const CommonEntries& common, double seconds) {
    Structure structure;
    structure.name = name;
    structure.thi = common.options();
    structure.candidates = true;
    structure.build_threads = index::thread_count(common.threads());
    structure.build_seconds = common.seconds() + seconds;
    return structure;
}

Recipe thi_of(const FilePtr& file, const CommonEntriesPtr& common) {
    const auto build = [=](const index::Progress& progress) {
        index::ThiEntries entries = common->get(progress);
        const Stopwatch watch(Stopwatch::Of::all_threads);
        auto bytes = index::build_thi_tree(std::move(entries), progress, common->threads());
        const double seconds = watch.seconds();
        const auto own = std::make_shared<OwnThiTree>(std::move(bytes));
        const index::StepValues& values = file->values();
        const auto threshold = [keys = index::KeyMap(values.type, values.scaling)](
                                   const Query& query) { return keys.threshold(query.isovalue); };
        Structure structure = built_of("thi", *common, seconds);
        structure.bytes = own->bytes.size();
        structure.entries = own->tree.entries();
        structure.ids = [own, threshold](const Query& query, Ids& out) {
            out.clear();
            own->tree.search(query.instant.step, threshold(query), out);
        };
        structure.follow = [own, threshold](const Query& query) {
            own->tree.search_incremental(own->cursor, query.instant.step, threshold(query));
            return own->cursor.cells.size();
        };
        structure.normal_error = [file, own](double isovalue) {
            return normal_error(file->values(), own->tree, isovalue);
        };
        return structure;
    };
    return {name_with("thi", common->options()), build};
}

struct NamedVariant {
    ThiVariant variant;
    const char* name;
};
constexpr std::array kVariants{NamedVariant{ThiVariant::node_lattices, "thi-node-lattices"},
                               NamedVariant{ThiVariant::interval_trees, "thi-interval-trees"},
                               NamedVariant{ThiVariant::compact_lists, "thi-compact-lists"}};

Recipe variant_of(const FilePtr& file, const NamedVariant& variant,
                  const CommonEntriesPtr& common) {
    const auto build = [=](const index::Progress& progress) {
        index::ThiEntries entries = common->get(progress);
        const Stopwatch watch(Stopwatch::Of::all_threads);
        const std::shared_ptr<const ThiVariantTree> tree =
            build_thi_variant(variant.variant, std::move(entries), progress, common->threads());
        const double seconds = watch.seconds();
        const index::KeyMap keys(file->values().type, file->values().scaling);
        Structure structure = built_of(variant.name, *common, seconds);
        structure.bytes = tree->bytes();
        structure.entries = tree->entries();
        structure.ids = [tree, keys](const Query& query, Ids& out) {
            out.clear();
            tree->search(query.instant.step, keys.threshold(query.isovalue), out);
        };
        return structure;
    };
    return {name_with(variant.name, common->options()), build};
}

} // namespace

Structure build_tbon(const FilePtr& file, unsigned threads) {
    const Stopwatch watch(Stopwatch::Of::all_threads);
    const auto tbon = std::make_shared<const Tbon>(file->values(), threads);
    Structure structure;
    structure.name = "tbon";
    structure.bytes = tbon->bytes();
    structure.build_threads = index::thread_count(threads);
    structure.build_seconds = watch.seconds();
    structure.ids = [file, tbon](const Query& query, Ids& out) {
        out.clear();
        tbon->search(query, out);
    };
    return structure;
}

std::vector<Recipe> structures_of(const FilePtr& file, const Structure& tbon,
                                  const StructureOptions& options) {
    std::vector<Recipe> all{scan_of(file),
                            {tbon.name, [tbon](const index::Progress&) { return tbon; }}};
    if (file->plan().tiers.has(index::Tier::bricks))
        all.push_back(bricks_of(file));
    for (const std::uint32_t lattice : options.lattices)
        for (const std::uint32_t max_variation : options.max_variations) {
            const auto common = std::make_shared<CommonEntries>(
                file, index::ThiOptions{lattice, max_variation}, options.threads);
            all.push_back(thi_of(file, common));
            for (const NamedVariant& variant : kVariants)
                all.push_back(variant_of(file, variant, common));
        }
    return all;
}

} // namespace isochron::bench
