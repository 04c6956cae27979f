// Reads the values of a dataset of an HDF5 file.
#pragma once

#include "index/readers/decoders/hdf5/hdf5_file.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

/// The values of one dataset, which stays open.
class Hdf5Values {
  public:
    /// @param shared the dimension along which values are read one by one; none: all at once.
    ///        Chunks that several of these reads share are kept, if 512 MiB are enough
    /// @throws Error when the file is too small to hold it, or a filter is missing
    Hdf5Values(const Hdf5File& file, const Hdf5Dataset& dataset, std::optional<std::size_t> shared);

    /// Number of values of a chunk along each dimension; empty if there are no chunks.
    const std::vector<std::uint64_t>& chunk() const { return chunk_; }
    /// Whether a part of a chunk costs no more than its share of the chunk: the chunk has no
    /// filters and is larger than HDF5's cache, or it is large, a whole step, and kept.
    bool in_parts() const { return in_parts_; }

    /// Reads the box of values at `start` with `count` values along each dimension, in the
    /// dataset's type and the machine's byte order. @throws Error naming file and dataset
    void read(std::span<const std::uint64_t> start, std::span<const std::uint64_t> count,
              std::span<std::byte> out) const;

  private:
    void expect_filters(std::int64_t properties) const;
    void expect_room_for(std::int64_t properties, const std::filesystem::path& path) const;

    const Hdf5File& file_;
    Hdf5Dataset dataset_;
    Hdf5Handle open_, space_;
    std::vector<std::uint64_t> chunk_;
    bool in_parts_ = false;
};

} // namespace isochron::index
