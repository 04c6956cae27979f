// The arrays by which surfaces of an index can be colored.
#pragma once

#include "index/file/index_file.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// One array to color by: the array of values alone that an index may carry (`IndexFile::color`),
/// or one of its arrays with search structures. Valid as long as the index is open.
class ColorSource {
  public:
    /// Number of them: first the array of values alone if there is one, then the others in their
    /// order. An index with one array and no colors has none: it has one value on a surface.
    static std::size_t count(const IndexFile& file);
    /// @param number from 0, below `count`
    ColorSource(const IndexFile& file, std::size_t number);

    /// Name, unit and range.
    const ColorArray& array() const { return array_; }
    /// Its chunks at a level of detail; null if the index refers to its sources and has none there.
    const ChunkStore* chunks(std::size_t level = 0) const;
    /// One step; see `IndexFile::load`.
    LoadedStep load(std::uint32_t step, const std::stop_token& stop) const;

  private:
    const IndexFile* file_;
    bool values_alone_;
    ColorArray array_;
};

/// The names of the arrays to color by, by their numbers.
std::vector<std::string> color_source_names(const IndexFile& file);

/// The number of the array to color by with this name. If there is none, or the name is empty, the
/// array of values alone, else the first that is not the one of the surfaces.
/// @param surfaces number of their array, as `IndexFile::array` takes it
std::size_t color_source_called(const IndexFile& file, std::string_view name, std::size_t surfaces);

} // namespace isochron::index
