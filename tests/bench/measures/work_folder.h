// A temporary folder for the files of a benchmark.
#pragma once

#include "index/error.h"

#include <filesystem>
#include <stdlib.h>
#include <string>

namespace isochron::bench {

/// Deleted with its contents by the destructor.
class WorkFolder {
  public:
    explicit WorkFolder(const std::filesystem::path& parent) {
        std::string pattern = (parent / "isochron_bench_XXXXXX").string();
        if (!mkdtemp(pattern.data()))
            throw index::Error("{}: no folder can be made in it", parent.string());
        path_ = pattern;
    }
    ~WorkFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

} // namespace isochron::bench
