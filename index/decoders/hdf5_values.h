// The values of a dataset of an HDF5 file.
#pragma once

#include "index/decoders/hdf5_file.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

/// The values of one dataset, which stays open.
class Hdf5Values {
  public:
    /// @param shared the dimension along which reads go one by one, none: all are read at once.
    ///        Chunks that several of them share are kept, where 512 MiB do
    /// @throws Error when the file is too small to hold it, or a filter is missing
    Hdf5Values(const Hdf5File& file, const Hdf5Dataset& dataset, std::optional<std::size_t> shared);

    /// Values along each dimension of a chunk; empty where there are no chunks.
    const std::vector<std::uint64_t>& chunk() const { return chunk_; }

    /// The box of values from `start`, `count` along each dimension, in the dataset's type and the
    /// machine's byte order. @throws Error naming file and dataset
    void read(std::span<const std::uint64_t> start, std::span<const std::uint64_t> count,
              std::span<std::byte> out) const;

  private:
    void expect_filters(std::int64_t properties) const;
    void expect_room_for(std::int64_t properties, const std::filesystem::path& path) const;

    const Hdf5File& file_;
    Hdf5Dataset dataset_;
    Hdf5Handle open_, space_;
    std::vector<std::uint64_t> chunk_;
};

} // namespace isochron::index
