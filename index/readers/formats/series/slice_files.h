// Series of TIFF files: a file for each step, or for each slice of the steps.
#pragma once

#include "index/readers/formats/format.h"
#include "index/readers/formats/series/file_series.h"

namespace isochron::index {

/// Numbers in the names say what a file is: behind `z` or `slice` the slice, behind `t`, `time` or
/// `frame` the step, behind `c`, `ch` or `channel` the channel, which `--array "channel 1"` picks.
/// If only one number differs, it is the slice if files have one page each, else the step. Numbers
/// in the names of folders count, too: `t00/z001.tif`, `003/0001.tif`.
/// @throws Error naming files: names that are not alike, numbers that are missing, no channel
///         chosen
/// @see Format::join
std::vector<SeriesFile> tiff_series(const Format& format,
                                    const std::vector<std::filesystem::path>& files,
                                    const ReadOptions& options);

} // namespace isochron::index
