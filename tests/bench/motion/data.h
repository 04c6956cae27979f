// The data of the motion benchmark: made by name, always the same, and kept as indices.
#pragma once

#include "app/frame/explorer_state.h"
#include "index/file/index_file.h"
#include "index/progress.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace isochron::bench {

/// The form of the values.
enum class MovedField : std::uint8_t {
    vorticity,  ///< vorticity of a real flow, as `isochron generate vorticity` makes it
    turbulence, ///< |curl| of random waves (app/generate/fourier_modes.h)
    tubes,      ///< around the lines where two sums of waves are 0
    specks      ///< blobs of a voxel or two, each on its way
};

struct MovedData {
    std::string name; ///< as `--data` and the rows have it
    std::string kept; ///< name of the index, which several may share
    MovedField field{};
    std::size_t size = 64; ///< vertices along each axis
    std::size_t steps = 4;
    index::ValueType type = index::ValueType::f32;
    int longest = 10;                   ///< wave number, of turbulence
    std::vector<double> isovalues = {}; ///< empty: the one that the program starts with
    float opacity = 1;
    bool colors = false; ///< by a second array
    bool large = false;  ///< only where all is measured
};

/// All, in the order in which they are measured.
const std::vector<MovedData>& moved_data();
std::vector<std::string> moved_names();
/// @param name one of them
const MovedData& moved(const std::string& name);

/// Opens the index of these data; makes it if the folder has none.
std::shared_ptr<const index::IndexFile> open_moved(const MovedData& data,
                                                   const std::filesystem::path& folder,
                                                   const index::Progress& progress);

/// What is shown of the data at first. @param state as a session starts
app::ExplorerState shown_of(const MovedData& data, app::ExplorerState state);

} // namespace isochron::bench
