// One file that is open in a reader: the interface of each format that a library decodes.
#pragma once

#include "index/readers/process/reader_messages.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace isochron::index {

class DecodedFile {
  public:
    virtual ~DecodedFile() = default;

    /// What the file holds and its number of steps, as in `VolumeFile`.
    const SeriesInfo& info() const { return info_; }
    virtual std::size_t steps() const = 0;

    /// Number of slices for one request: those that the library decodes together, or enough to be
    /// worth a request; at most all.
    virtual std::uint32_t slices_at_once() const = 0;
    /// [bytes] of a step in the library's memory.
    virtual std::uint64_t decoded_bytes() const = 0;

    /// Writes slices of one step in the format of `VolumeSeries::read`. `slices` begin at a
    /// multiple of `slices_at_once`; they are that many, or all that are left.
    /// @throws Error naming the file
    virtual void read(std::size_t step, Slices slices, std::span<std::byte> out) = 0;

  protected:
    SeriesInfo info_; ///< whole once the file is open
};

/// A number of slices that makes a request cheap compared with copying them, while they fit the
/// cache.
std::uint32_t slices_worth_asking(const SeriesInfo& info);

/// Opens one file, reading no more than it must to describe it. @throws Error naming the file
using OpenDecodedFile = std::unique_ptr<DecodedFile> (*)(const std::filesystem::path&,
                                                         const ReadOptions&);

} // namespace isochron::index
