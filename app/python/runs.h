// An open index as the Python module asks it: by several threads at once, with answers in plain
// vectors.
#pragma once

#include "app/python/array_series.h"
#include "index/file/index_file.h"
#include "index/measure/measures.h"
#include "index/progress.h"
#include "index/search/cell_change.h"
#include "index/search/first_crossing.h"
#include "index/search/index_search.h"
#include "index/search/surface_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// Work spaces, each for one thread at a time: one that is given back serves the next who asks.
template <class Work>
class WorkSpaces {
  public:
    /// Calls `use(work)` with a work space that nobody else has. @param make a new one
    template <class Make, class Use>
    auto with(Make&& make, Use&& use) {
        std::unique_ptr<Work> work;
        if (const std::lock_guard lock(mutex_); !idle_.empty()) {
            work = std::move(idle_.back());
            idle_.pop_back();
        }
        if (!work)
            work = make();
        auto result = use(*work); // a work space of failed work is not used again
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(work));
        return result;
    }

  private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Work>> idle_;
};

/// Cell numbers: `wide` where the grid has so many cells that their numbers take 64 bits.
struct CellNumbers {
    std::vector<std::uint32_t> narrow;
    std::vector<std::uint64_t> wide;
    bool are_wide = false;
};

/// The cells that only one of two queries has, ascending.
struct CellDifference {
    std::vector<std::uint32_t> added, removed;
};

template <class Number>
struct Triangles {
    std::vector<Number> points; ///< x, y, z, less the grid's origin or not
    /// Counter-clockwise in physical space as seen from the side of lower values.
    std::vector<std::uint32_t> faces;
    std::vector<float> normals; ///< if wished: x, y, z, towards lower values
    std::vector<float> values;  ///< if wished: of another array, at the points
};

/// What a mesh has besides its triangles.
struct WishedOfMesh {
    bool normals = false;
    std::optional<std::string> values; ///< name of the array whose values are wanted
    std::uint32_t dust = 0;            ///< pieces of fewer active cells are left out
};

/// A range of vertices along z, y and x: the first, and the one after the last.
using Box = std::array<std::array<std::uint32_t, 2>, 3>;

/// One array of an open index. Thread-safe.
class RunArray {
  public:
    explicit RunArray(std::shared_ptr<const index::IndexFile> file) : file_(std::move(file)) {}

    const index::IndexFile& file() const { return *file_; }
    /// Each of these throws index::Error: there is no such step, or the file is damaged.
    /// An instant is a step and so many 65536ths of the way to the next one.
    struct AskedInstant {
        std::int64_t step, fraction;
    };
    /// @param level of detail, below `IndexFile::detail_levels`; 0: the volume itself
    CellNumbers cells(const AskedInstant& at, double isovalue, std::size_t level);
    CellDifference change(const AskedInstant& at, double isovalue, const AskedInstant& to,
                          double to_isovalue);
    /// Coordinates less the grid's origin, as floats.
    Triangles<float> mesh_from_origin(const AskedInstant& at, double isovalue, std::size_t level,
                                      const WishedOfMesh& wished);
    Triangles<double> mesh(const AskedInstant& at, double isovalue, std::size_t level,
                           const WishedOfMesh& wished);
    /// @param on_surface name of the array to measure on the surface
    /// @param dust pieces of fewer active cells are left out @param from place of the distance
    index::MeasuredSurface measure(const AskedInstant& at, double isovalue,
                                   const std::optional<std::string>& on_surface, bool pieces,
                                   const std::optional<index::VertexBox>& box,
                                   const std::optional<index::CutPlane>& clip, std::uint32_t dust,
                                   const std::optional<glm::dvec3>& from);
    /// Stored values, x fastest; between two steps, as index::Blend stores them. Reads the chunks in
    /// which the box lies, and no others, unless the index refers to its sources.
    std::vector<std::byte> values(const AskedInstant& at, const Box& box, std::size_t level) const;
    /// Scaled values between two steps.
    std::vector<double> blended_values(const AskedInstant& at, const Box& box,
                                       std::size_t level) const;
    /// `index::profile_of` from place to place, as `index::rows_of`.
    std::vector<double> profile(const AskedInstant& at, std::vector<glm::dvec3> places) const;
    /// When each cell is first active. @param blended also between the steps
    index::FirstCrossings first_crossings(double isovalue, bool blended) const;

  private:
    index::Query query(const AskedInstant& at, double isovalue) const;
    index::CellMesh packed_mesh(const AskedInstant& at, double isovalue, std::size_t level,
                                const WishedOfMesh& wished);
    std::optional<std::size_t> source_called(const std::optional<std::string>& name) const;

    std::shared_ptr<const index::IndexFile> file_;
    WorkSpaces<index::SearchInto> searches_;
    WorkSpaces<index::ChangeSearch> changes_;
    WorkSpaces<index::SurfaceMeshes> meshes_;
    WorkSpaces<index::SurfaceMeasures> measures_;
};

/// An open index. Thread-safe.
class OpenRun {
  public:
    /// @throws index::Error as `index::open_named_index`
    explicit OpenRun(const std::filesystem::path& path);

    const index::IndexFile& file() const { return arrays_.front()->file(); }
    /// @param name none: the first @throws index::Error naming the arrays if there is no such array
    RunArray& array(const std::optional<std::string>& name) const;
    /// What a damaged index has lost, if anything.
    std::optional<std::string> lost() const;

  private:
    std::vector<std::unique_ptr<RunArray>> arrays_;
};

/// Indexes files, or arrays of Python, or appends their further steps.
/// @param words options as `isochron build` has them, without files and output
/// @param times of the steps; empty: as they are stated
/// @param arrays null: files are read
/// @return notes @throws index::Error as reading does; UsageError; what `progress` throws
std::vector<std::string> build_run(const std::vector<std::string>& files,
                                   const std::filesystem::path& out,
                                   const std::vector<std::string>& words,
                                   const std::vector<double>& times, const PythonArrays* arrays,
                                   const index::Progress& progress);

} // namespace isochron::app
