// Reads the source tree for its tests: files, the order of folders, and includes.
#pragma once

#include "tests/support/test_folder.h"

#include <filesystem>
#include <string>
#include <vector>

namespace isochron::house {

inline constexpr const char* kFloors[]{"index", "interaction", "render", "stereo", "app"};

/// The tree that these tests are part of.
std::filesystem::path checkout();

struct Include {
    int line;         ///< from 1
    std::string path; ///< as it is written: `render/gl/gl.h`
};

/// Headers and sources (.h, .cpp) below a folder of the tree, as paths from `root`, sorted. None
/// where there is no such folder.
std::vector<std::string> sources(const std::filesystem::path& root, const std::string& folder);

/// What a file includes by name from a folder of the tree, in its order.
std::vector<Include> includes_of(const std::filesystem::path& file);

/// A folder for a planted violation, empty at first and removed at the end.
class PlantedTree {
  public:
    /// Writes a file; its folders are made.
    void plant(const std::string& path, const std::string& text) const;
    const std::filesystem::path& root() const { return folder_.path(); }

  private:
    test_support::TestFolder folder_;
};

} // namespace isochron::house
