// The .isochron file: one memory-mapped file with the volume and its search structures.
#pragma once

#include "index/step_values.h"
#include "index/thi_tree.h"
#include "index/volume_series.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace isochron::index {

struct BuildOptions {
    ThiOptions tree;
    bool exact_only = false; ///< no tree: every query scans the volume
    /// A longer series gets no tree, and a note that says so: building one takes some 30 bytes of
    /// memory per cell-step.
    std::uint64_t max_tree_cell_steps = 100'000'000;
};

/// Reads a series once and writes NAME.isochron under a temporary name, then renames it.
/// On any failure, also a cancelled one, nothing is left behind. An existing index is replaced;
/// any other existing file is refused. The same series and options give the same bytes.
/// @throws Error: as the series reads, unwritable, disk full, larger than `CellId` can count
void build_index(VolumeSeries& series, const std::filesystem::path& out,
                 const BuildOptions& options, const Progress& progress = {});

constexpr std::size_t kHistogramBins = 256;

/// Everything known about a file's contents besides the values.
struct IndexStats {
    double low = 0, high = 0;             ///< range of the finite scaled values
    std::uint64_t nan_values = 0;         ///< vertex-steps that are NaN
    std::vector<std::uint64_t> histogram; ///< kHistogramBins equal bins over [low, high], all steps
    std::uint64_t file_bytes = 0, volume_bytes = 0, tree_bytes = 0;
};

/// An open index: immutable, thread-safe, owns the mapping. Opening checks the header and the
/// metadata and touches nothing else; `verify` checks the rest. A mapped file that is made shorter,
/// or whose disk fails, ends the program with SIGBUS.
class IndexFile {
  public:
    /// @throws Error: missing, truncated, foreign, newer version, damaged header
    static std::shared_ptr<const IndexFile> open(const std::filesystem::path& path);
    virtual ~IndexFile() = default;

    virtual const SeriesInfo& info() const = 0;
    virtual const IndexStats& stats() const = 0;
    virtual const StepValues& values() const = 0;
    /// Null when the file carries none. Checked when first asked for, which reads the whole tree:
    /// not for the thread that draws. @throws Error when it is damaged
    virtual const ThiTree* tree() const = 0;
    virtual const BuildOptions& options() const = 0; ///< what it was built with
    virtual std::uint64_t
    content_hash() const = 0; ///< of the values and grid: the same data, the same hash

    /// Compares the checksum of every section; reads the whole file.
    /// @throws Error naming the damaged section
    virtual void verify(const Progress& progress = {}) const = 0;
};

} // namespace isochron::index
