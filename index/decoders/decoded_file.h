// One file that is open in a reader: what each format implements that a library decodes.
#pragma once

#include "index/reader/reader_messages.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace isochron::index {

class DecodedFile {
  public:
    virtual ~DecodedFile() = default;

    /// As `VolumeFile` has them.
    virtual const SeriesInfo& info() const = 0;
    virtual std::size_t steps() const = 0;

    /// Slices that the library decodes together anyway, or that are many enough to be worth asking
    /// for; at most all.
    virtual std::uint32_t slices_at_once() const = 0;
    /// [bytes] of a step as the library holds it.
    virtual std::uint64_t decoded_bytes() const = 0;

    /// Writes slices of one step, as `VolumeSeries::read` has them. `slices` begin at a multiple of
    /// `slices_at_once` and are as many, or all that are left. @throws Error naming the file
    virtual void read(std::size_t step, Slices slices, std::span<std::byte> out) = 0;
};

/// So many slices that a request is small beside their copying, and they stay in the cache.
std::uint32_t slices_worth_asking(const SeriesInfo& info);

/// Opens one file, reading no more than it must to describe it. @throws Error naming the file
using OpenDecodedFile = std::unique_ptr<DecodedFile> (*)(const std::filesystem::path&,
                                                         const ReadOptions&);

} // namespace isochron::index
