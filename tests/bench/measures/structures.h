// The search structures that are measured, in the order of their rows.
#pragma once

#include "index/file/index_file.h"
#include "index/progress.h"
#include "tests/bench/measures/structure.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isochron::bench {

/// How to build a structure. They are built one after the other, as memory cannot hold all of them.
struct Recipe {
    std::string what; ///< for the progress: `thi L 64, MaxVariation 2`
    std::function<Structure(const index::Progress&)> build;
};

struct StructureOptions {
    std::vector<std::uint32_t> lattices{32, 64, 128}; ///< SpanSpaceSize L of the THI trees
    std::vector<std::uint32_t> max_variations{1, 2, 3};
    unsigned threads = 0; ///< for building; 0: one for each processor
};

/// The T-BON, with which all others are also compared.
Structure build_tbon(const std::shared_ptr<const index::IndexFile>& file, unsigned threads);

/// The scan, the T-BON, the index's bricks, and for every setting the THI tree and its variants.
std::vector<Recipe> structures_of(const std::shared_ptr<const index::IndexFile>& file,
                                  const Structure& tbon, const StructureOptions& options);

} // namespace isochron::bench
