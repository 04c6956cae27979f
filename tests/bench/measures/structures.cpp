// The search structures that are measured.
#include "tests/bench/measures/structures.h"

#include "index/scan/scan.h"
#include "index/system/parallel.h"
#include "index/thi/thi_tree.h"
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
                    index::scan(file->values(), query, out);
                };
                structure.full = [file](const Query& query, index::CellSet& set) {
                    index::scan(file->values(), query, set.ids); // already in order
                    index::shade_cells(file->values(), set);
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

Recipe thi_of(const FilePtr& file, const index::ThiOptions& options, unsigned threads) {
    const auto build = [=](const index::Progress& progress) {
        const index::StepValues& values = file->values();
        const Stopwatch watch(Stopwatch::Of::all_threads);
        auto bytes = index::build_thi_tree(values, options, progress, threads);
        const double seconds = watch.seconds();
        const auto own = std::make_shared<OwnThiTree>(std::move(bytes));
        const auto threshold = [keys = index::KeyMap(values.type, values.scaling)](
                                   const Query& query) { return keys.threshold(query.isovalue); };
        Structure structure;
        structure.name = "thi";
        structure.thi = options;
        structure.bytes = own->bytes.size();
        structure.entries = own->tree.entries();
        structure.candidates = true;
        structure.build_threads = index::thread_count(threads);
        structure.build_seconds = seconds;
        structure.ids = [own, threshold](const Query& query, Ids& out) {
            own->tree.search(query.step, threshold(query), out);
        };
        structure.follow = [own, threshold](const Query& query) {
            own->tree.search_incremental(own->cursor, query.step, threshold(query));
            return own->cursor.cells.size();
        };
        structure.normal_error = [file, own](double isovalue) {
            return normal_error(file->values(), own->tree, isovalue);
        };
        return structure;
    };
    return {name_with("thi", options), build};
}

struct NamedVariant {
    ThiVariant variant;
    const char* name;
};
constexpr std::array kVariants{NamedVariant{ThiVariant::node_lattices, "thi-node-lattices"},
                               NamedVariant{ThiVariant::interval_trees, "thi-interval-trees"},
                               NamedVariant{ThiVariant::compact_lists, "thi-compact-lists"}};

Recipe variant_of(const FilePtr& file, const NamedVariant& variant,
                  const index::ThiOptions& options, unsigned threads) {
    const auto build = [=](const index::Progress& progress) {
        const index::StepValues& values = file->values();
        const Stopwatch watch(Stopwatch::Of::all_threads);
        const std::shared_ptr<const ThiVariantTree> tree =
            build_thi_variant(variant.variant, values, options, progress, threads);
        const double seconds = watch.seconds();
        const index::KeyMap keys(values.type, values.scaling);
        Structure structure;
        structure.name = variant.name;
        structure.thi = options;
        structure.bytes = tree->bytes();
        structure.entries = tree->entries();
        structure.candidates = true;
        structure.build_threads = index::thread_count(threads);
        structure.build_seconds = seconds;
        structure.ids = [tree, keys](const Query& query, Ids& out) {
            tree->search(query.step, keys.threshold(query.isovalue), out);
        };
        return structure;
    };
    return {name_with(variant.name, options), build};
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
    structure.ids = [file, tbon](const Query& query, Ids& out) { tbon->search(query, out); };
    return structure;
}

std::vector<Recipe> structures_of(const FilePtr& file, const Structure& tbon,
                                  const StructureOptions& options) {
    std::vector<Recipe> all{scan_of(file),
                            {tbon.name, [tbon](const index::Progress&) { return tbon; }}};
    for (Recipe& recipe : tiers_of(file))
        all.push_back(std::move(recipe));
    for (const std::uint32_t lattice : options.lattices)
        for (const std::uint32_t max_variation : options.max_variations) {
            const index::ThiOptions thi{lattice, max_variation};
            all.push_back(thi_of(file, thi, options.threads));
            for (const NamedVariant& variant : kVariants)
                all.push_back(variant_of(file, variant, thi, options.threads));
        }
    return all;
}

} // namespace isochron::bench
