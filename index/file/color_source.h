// The arrays by which surfaces of an index can be colored.
#pragma once

#include "index/file/index_file.h"
#include "index/file/step_view.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// One array to color by: the array without search structures that an index may carry for colors
/// only (`IndexFile::color`), or one of its other arrays. Valid as long as the index is open.
class ColorSource {
  public:
    /// Number of arrays to color by: first the one for colors only, if any, then the others in
    /// order. 0 if the index has only one array: on a surface all its values are the same.
    static std::size_t count(const IndexFile& file);
    /// @param number from 0, below `count`
    ColorSource(const IndexFile& file, std::size_t number);

    /// Name, unit and range.
    const ColorArray& array() const { return array_; }
    /// Its chunks at a level of detail; null if the index refers to its sources and has none there.
    const ChunkStore* chunks(std::size_t level = 0) const;
    /// This array at the step of the surfaces, whole or in chunks of the same level of detail as
    /// that step is. @param surfaces by chunks: there are chunks at its level
    StepView step(const StepView& surfaces) const;

  private:
    const IndexFile* file_;
    bool values_alone_;
    ColorArray array_;
};

/// The names of the arrays to color by, by their numbers.
std::vector<std::string> color_source_names(const IndexFile& file);

/// @return none: no array has this name
std::optional<std::size_t> color_source_named(const IndexFile& file, std::string_view name);

/// The number of the array to color by with this name. If there is none, or the name is empty: the
/// array for colors only, or else the first array that is not the one of the surfaces, if possible one
/// with more than one value.
/// @param surfaces number of their array, as `IndexFile::array` takes it
std::size_t color_source_called(const IndexFile& file, std::string_view name, std::size_t surfaces);

} // namespace isochron::index
