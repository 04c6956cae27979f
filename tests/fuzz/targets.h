// What is fuzzed: functions that take any bytes, and end the program where they find a fault.
//
// Each throws nothing: an input that is refused with the floor's own Error is fine, and anything
// else that is thrown is a fault.
#pragma once

#include "tests/fuzz/claims.h"

#include <span>
#include <string_view>

namespace isochron::fuzz {

struct Target {
    std::string_view name; ///< also of its folders in corpus/ and found/, and of its dictionary
    void (*run)(Bytes input);
};

/// Files of volumes, whole: header and values; headers of BOV, MetaImage and NRRD beside files of
/// values. Units of time, two lines. Messages of readers.
std::span<const Target> volume_targets();

/// What readers parse themselves: XDMF documents; Zarr hierarchies, as
/// text with a line `@key` before each value, and as zip files; descriptions in TIFF files; models.
std::span<const Target> decoder_targets();

/// Grids as VTK's readers may give them, from a row of choices, resampled and read; text that is
/// checked and changed before VTK reads it.
std::span<const Target> mesh_targets();

/// Indices, whole: their checksums are made to match before they are read.
std::span<const Target> index_targets();

/// Recordings, and datagrams of trackers, each behind its length in two bytes, the lower one first.
std::span<const Target> interaction_targets();

/// Configurations, ParaView's descriptions of CAVEs, and what the processes of a cluster tell each
/// other: a byte that says which message, then its CBOR. Requests of the control socket, line by line.
std::span<const Target> app_targets();

} // namespace isochron::fuzz
