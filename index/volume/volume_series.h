// A time-varying scalar volume as its files give it: its description, and its steps one by one.
#pragma once

#include "index/volume/calendar.h"
#include "index/volume/grid.h"
#include "index/volume/value_type.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// The meaning of the axes of physical space. `ras` (NIfTI) and `lps` (DICOM, MetaImage, NRRD) are
/// anatomical, with +z towards the head; `enu` (NetCDF) is east, north, up on the Earth's surface.
/// All are right-handed.
enum class Anatomy : std::uint8_t { none, ras, lps, enu };

struct SeriesInfo {
    std::vector<std::string> arrays; ///< arrays that there are to choose from, each with its type
    std::string array;       ///< name of the scalar array, with its component: `velocity.magnitude`
    std::string value_unit;  ///< empty when the files do not say
    std::string length_unit; ///< `mm`, `m`, ... or empty
    std::string time_unit;   ///< `s`, `ms`, ... or empty
    Anatomy anatomy = Anatomy::none;
    Grid grid;
    /// What the axes of physical space are called, `depth`; `longitude (degrees)` where they have
    /// units of their own. Empty: x, y, z.
    std::array<std::string, 3> axis_names;
    ValueType type = ValueType::f32;
    Scaling scaling;
    int digits = kFewestDigits; ///< significant ones in words, see `telling_digits`
    std::vector<double>
        times; ///< physical time of every step, increasing; the step number if unknown
    /// Steps, ascending, behind which numbers or dates are missing in the names of the files.
    std::vector<std::uint32_t> missing_after;
    std::vector<std::string> sources; ///< file names, natural order
    std::vector<std::string> notes;   ///< what a user should know: `cell data averaged to vertices`

    std::size_t steps() const { return times.size(); }
    std::size_t step_bytes() const { return grid.vertex_count() * size_of(type); }
};

/// How to read files whose contents leave something open.
struct ReadOptions {
    std::optional<std::string> array; ///< --array
    /// --component: a number from 0, `magnitude`, or what is computed: `gradient`, `vorticity`,
    /// `q-criterion`.
    std::optional<std::string> component;
    /// Takes the first array, and the length of vectors, where a user would have to choose: for
    /// describing files.
    bool any_array = false;
    bool allow_surplus = false; ///< --allow-surplus: more values may follow than the header says
    bool extra_axis_is_time =
        false; ///< --extra-axis-is-time: an axis beside those of space is time
    std::optional<std::uint32_t> member; ///< --member: the run of an ensemble, counted from 0
    bool times_from_names = false;       ///< --times-from-names: the number in each file's name
    std::optional<DayMonth> dates;       ///< --dates: dmy or mdy
    bool keep_first = false; ///< --keep-first: of steps with the same time not the last, the first
    /// --resample NX NY NZ: grids that are not regular become one of so many vertices.
    std::optional<std::array<std::uint32_t, 3>> resample;
    /// --crop X0:X1,Y0:Y1,Z0:Z1: the first and the last vertex to read along each axis.
    std::optional<std::array<std::array<std::uint32_t, 2>, 3>> crop;
    std::optional<std::array<std::uint32_t, 3>> stride; ///< --stride: each such vertex only
    /// --steps A:B[:C]: the first and the last step to read, and each how many of them.
    std::optional<std::array<std::uint64_t, 3>> steps;
    /// If each slice of a step has its own file: these files, in order. Only `open_series` sets it.
    std::vector<std::filesystem::path> slices;
    // Headerless raw files only:
    std::optional<std::array<std::uint32_t, 3>> dims; ///< --dims NX NY NZ, vertices
    std::optional<ValueType> type;                    ///< --type; of other files: converted to it
    bool big_endian = false;                          ///< --big-endian
    std::uint64_t header_bytes = 0;                   ///< --header-bytes: skipped at the start
    // Override what the files say, or add what they do not say:
    std::optional<glm::dvec3> spacing;      ///< --spacing
    std::optional<glm::dvec3> origin;       ///< --origin
    std::optional<double> time_step;        ///< --time-step: physical time between steps
    std::optional<std::string> length_unit; ///< --length-unit
    std::optional<std::string> time_unit;   ///< --time-unit
    std::optional<std::string> value_unit;  ///< --value-unit

    bool operator==(const ReadOptions&) const = default;
};

/// Counts the ways in which programs have understood the same files: raised when axes, places,
/// times or missing values of some format are read otherwise than before.
constexpr std::uint32_t kReading = 4;

/// Receives the stored values of a step, piece by piece.
using TakePiece = std::function<void(std::span<const std::byte>)>;

/// A series of steps. Not thread-safe: one owner.
class VolumeSeries {
  public:
    virtual ~VolumeSeries() = default;
    virtual const SeriesInfo& info() const = 0;

    /// Writes the stored values of one step, [z][y][x], x fastest, native byte order.
    /// @param out exactly `info().step_bytes()` long
    /// @throws Error naming the file when it cannot be read or disagrees with the first step
    virtual void read(std::size_t step, std::span<std::byte> out) = 0;

    /// Reads a step in consecutive pieces of whole values; a piece is valid until `take` returns.
    /// If the format allows it, the whole step is never in memory.
    virtual void stream(std::size_t step, const TakePiece& take) {
        std::vector<std::byte> whole(info().step_bytes());
        read(step, whole);
        take(whole);
    }

    /// This series, opened for another thread that reads at the same time; null if that gains
    /// nothing, as for many steps in one file that is decoded from its start.
    virtual std::unique_ptr<VolumeSeries> another() const { return nullptr; }

    /// A number that changes when the source of a step is written to; 0 if that cannot be told
    /// without reading.
    virtual std::uint64_t state(std::size_t /*step*/) const { return 0; }

    /// The files that the series is known to read, without files that a library finds by itself.
    virtual std::vector<std::filesystem::path> files() const { return {}; }
};

} // namespace isochron::index
