// The images of DICOM files: what is known of each before its pixels are read.
//
// https://dicom.nema.org/medical/dicom/current/output/html/part03.html
#pragma once

#include "index/readers/formats/stored_scalar.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace isochron::index {

/// What can tell the times of images at the same place apart, the best first.
enum class DicomClock : std::uint8_t {
    described_phase,  ///< in the words on a series that is a phase of a scan, in percent
    described_number, ///< likewise, counted
    time_offset,
    frame_time,  ///< by vectors of a file of many frames that says how long they take
    frame_count, ///< by vectors that only count
    cardiac_delay,
    trigger_time,
    respiratory_delay,
    reference_time,
    cardiac_phase,
    respiratory_phase,
    temporal_index,
    temporal_position,
    reference_moment,
    frame_moment,
    acquisition_moment,
    acquisition_time,
    content_time,
    series_time,
    frame_acquisition,
    image_index,
    acquisition,
    dimension, ///< dimensions of an enhanced file that are neither place nor time
    instance,
};
constexpr std::size_t kDicomClocks = 24;

/// An image: a file, a frame of one, or a tile of a mosaic.
struct DicomImage {
    std::size_t file = 0;               ///< its number in the list of files
    std::uint32_t frame = 0;            ///< counted from 0
    std::optional<glm::dvec3> position; ///< [mm] of the middle of the first pixel, LPS
    /// [mm], or counted where no distance is said: along the normal, where no position is said.
    std::optional<double> level;
    std::array<glm::dvec3, 2> along{glm::dvec3(1, 0, 0),
                                    glm::dvec3(0, 1, 0)}; ///< its rows, columns
    double rounding = 0;      ///< [mm] of the position as it is written: half of its last digit
    double turn_rounding = 0; ///< rounding of `along`
    std::optional<glm::dvec2> spacing; ///< [mm] between pixels of a row, between rows
    Scaling scaling;
    double duration = 0; ///< [ms]; 0: not said
    std::array<std::optional<double>, kDicomClocks> clocks{};
    /// Names and values that tell volumes apart: images of one volume have the same.
    std::vector<std::pair<std::string, std::string>> kind = {};

    std::optional<double>& clock(DicomClock of) { return clocks[static_cast<std::size_t>(of)]; }
    const std::optional<double>& clock(DicomClock of) const {
        return clocks[static_cast<std::size_t>(of)];
    }
};

/// What all images of a file share.
struct DicomFile {
    std::uint32_t columns = 0, rows = 0, frames = 1;
    /// Tiles of a mosaic, whose slices are the frames; 1 x 1: each frame is stored as it is.
    std::uint32_t tiles_across = 1, tiles_down = 1;
    std::uint32_t samples = 1;   ///< samples per pixel: 1, or 3 for red, green and blue
    std::uint64_t pixels_at = 0; ///< [bytes] where they are stored as they are; 0: to be decoded
    bool big_endian = false;     ///< byte order of pixels that are stored as they are
    bool planar = false;         ///< samples lie apart, in each frame
    StoredType type = StoredType::u8;
    std::uint32_t bits = 8, lowest_bit = 0; ///< bits of a sample that hold its value
    std::string modality = {}, value_unit = {};
    std::string description = {};   ///< description of its series
    std::string comments = {};      ///< comments on its images
    bool of_patient = true;         ///< positions are said in the space of a patient
    double slice_spacing = 0;       ///< [mm]; 0: not said
    double temporal_resolution = 0; ///< [ms] between temporal positions; 0: not said
    /// [ms] between excitations, which are volumes of an echo-planar scan; 0: not said.
    double repetition_time = 0;
    double temporal_positions = 0; ///< their number; 0: not said
    std::string frames_by = {};    ///< names of the attributes that are `frame_time`, `frame_count`
    std::string dimensions_by = {}; ///< names of the attributes that are `dimension`
    std::vector<std::string> notes = {};
    std::vector<DicomImage> images = {}; ///< one for each frame; none: the file holds no image
};

} // namespace isochron::index
