// One open file of a series: the interface of each format.
#pragma once

#include "index/volume/volume_series.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace isochron::index {

/// A file with one step or several. Not thread-safe.
class VolumeFile {
  public:
    virtual ~VolumeFile() = default;

    /// The description from the file, without overrides. `times` is empty when the file gives none,
    /// otherwise has one for each step; `sources` is not used.
    virtual const SeriesInfo& info() const = 0;
    virtual std::size_t steps() const = 0;
    /// Other files with its values, such as the .raw of a .mhd.
    virtual std::vector<std::filesystem::path> beside() const { return {}; }

    /// What `VolumeSeries::read` does, for a step of this file.
    virtual void read(std::size_t step, std::span<std::byte> out) = 0;
    /// What `VolumeSeries::stream` does, for a step of this file.
    virtual void stream(std::size_t step, const TakePiece& take) = 0;

    /// Whether `read_at` reads no more than it is asked for.
    virtual bool reads_anywhere() const { return false; }
    /// Writes the stored values from number `first` of a step on. Only if `reads_anywhere`.
    virtual void read_at(std::size_t /*step*/, std::size_t /*first*/,
                         std::span<std::byte> /*out*/) {}
};

/// Opens one file, reading no more than it must to describe it. @throws Error naming the file
using OpenVolumeFile =
    std::function<std::unique_ptr<VolumeFile>(const std::filesystem::path&, const ReadOptions&)>;

} // namespace isochron::index
