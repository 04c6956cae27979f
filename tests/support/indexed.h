// The index of some values, in a folder of a test.
#pragma once

#include "index/indexing/index_build.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <memory>

namespace isochron::index {

inline std::shared_ptr<const IndexFile> indexed(const test_support::TestFolder& folder,
                                                const StepValues& values,
                                                const BuildOptions& options = {}) {
    MemorySeries series(values);
    build_index(series, folder.path() / "a.isochron", options);
    return IndexFile::open(folder.path() / "a.isochron");
}

} // namespace isochron::index
