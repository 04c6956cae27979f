// Models: files of triangles, read in processes of their own.
#pragma once

#include "index/volume/triangle_mesh.h"

#include <cstddef>
#include <filesystem>
#include <stop_token>
#include <string>

namespace isochron::index {

/// Whether a file is a model by its extension.
bool is_model_name(const std::filesystem::path& path);
/// The extensions of models, for messages: `.stl, .ply, ...`
std::string model_extensions();

/// Whether a name stands for one file for each step, as `hull_*.stl` and `hull_%04d.stl` do.
bool is_model_series(const std::filesystem::path& path);
/// The file of a step, in the natural order of their names. @param steps of the data
/// @throws Error: there are not as many files as steps, or this one is a link that leads out of the folder
std::filesystem::path file_of_model_series(const std::filesystem::path& path, std::size_t step,
                                           std::size_t steps);

/// Reads behind the fence of readers: nothing but the file and what lies in its folder is readable there.
/// Coordinates are those of the file, with the origin added that `isochron export` has subtracted.
/// @param unit of length of the data: coordinates of glTF, which are in meters, are converted to it;
/// others stay as they are, and so do all where it is not known
/// @throws Error naming the file, in one line: damaged, too large, no model by its name, or its
/// reader is not installed
/// @throws Interrupted when stopped
TriangleMesh read_model(const std::filesystem::path& path, const std::string& unit = {},
                        const std::stop_token& stop = {});

} // namespace isochron::index
