// Writes a series for ParaView: one .vti for each step, and a .pvd with the times.
//
//     index::SeriesWriter writer(dir, "sphere", info);
//     for (std::size_t step = 0; step < steps; ++step)
//         writer.append(std::as_bytes(std::span(values_of(step))), time_of(step));
//     writer.finish();      // only now do the files appear under their names
#pragma once

#include "index/system/temporary/temporary_folder.h"
#include "index/volume/volume_series.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// Writes `dir/name_0000.vti`, ... (appended raw, zlib) and `dir/name.pvd`, in the order of the
/// steps. The same values give the same bytes. If it is destroyed before `finish`, it removes what
/// it has written.
class SeriesWriter {
  public:
    /// Creates `dir`. @param info its grid, type and array name; times, units and sources are not
    /// used.
    /// @throws Error when the folder cannot be made, or `info.scaling` is set (a .vti has none)
    SeriesWriter(std::filesystem::path dir, std::string name, SeriesInfo info);
    ~SeriesWriter();
    SeriesWriter(const SeriesWriter&) = delete;
    SeriesWriter& operator=(const SeriesWriter&) = delete;

    /// The name of a step's file in the series called `name`.
    static std::string file_of(const std::string& name, std::size_t step);

    /// @param values stored values of one step, [z][y][x], x fastest, native byte order,
    ///               exactly `info.step_bytes()` long
    /// @param time physical time, greater than the time of the step before
    /// @throws Error when the file cannot be written, or size or time are not as above
    void append(std::span<const std::byte> values, double time);

    /// Gives every file its final name, the .pvd last. @throws Error when a file cannot be written
    void finish();

  private:
    struct Step {
        std::string file;
        double time;
    };

    // A NewFile for each step would keep its descriptor open until the end.
    std::filesystem::path temporary(const std::string& file) const {
        return temporary_->path() / file;
    }
    void publish(const std::string& file) const;
    std::string vti(std::span<const std::byte> values, double time) const;

    std::filesystem::path dir_;
    std::string name_;
    SeriesInfo info_;
    std::optional<TemporaryFolder> temporary_;
    std::vector<Step> steps_;
};

} // namespace isochron::index
