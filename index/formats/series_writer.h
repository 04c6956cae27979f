// Writes a series as ParaView reads it: one .vti per step and a .pvd with the times.
//
//     auto writer = index::write_pvd(dir, "sphere", info);
//     for (std::size_t step = 0; step < steps; ++step)
//         writer->append(std::as_bytes(std::span(values_of(step))), time_of(step));
//     writer->finish();      // only now do the files appear under their names
#pragma once

#include "index/volume/volume_series.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace isochron::index {

/// Writes steps in their order. Destroyed before `finish`, it removes what it has written.
class SeriesWriter {
  public:
    virtual ~SeriesWriter() = default;

    /// @param values stored values of one step, [z][y][x], x fastest, native byte order,
    ///               exactly `info.step_bytes()` long
    /// @param time physical time, greater than that of the step before
    /// @throws Error when the file cannot be written, or size or time are not as above
    virtual void append(std::span<const std::byte> values, double time) = 0;

    /// Gives every file its final name, the .pvd last. @throws Error when a file cannot be written
    virtual void finish() = 0;
};

/// Writes `dir/name_0000.vti`, ... (appended raw, zlib) and `dir/name.pvd`, creating `dir`. Takes
/// grid, type and array name from `info`; its times, units and sources are not used. The same
/// values give the same bytes.
/// @throws Error when the folder cannot be made, or `info.scaling` is set: a .vti carries none
std::unique_ptr<SeriesWriter> write_pvd(const std::filesystem::path& dir, const std::string& name,
                                        const SeriesInfo& info);

} // namespace isochron::index
