// What the headers of DICOM files say of their images.
//
// https://dicom.nema.org/medical/dicom/current/output/html/part03.html
#pragma once

#include "index/readers/formats/stored_scalar.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace isochron::index {

/// What can tell the times of images at the same place apart, the best first.
enum class DicomClock : std::uint8_t {
    time_offset,       ///< s
    trigger_time,      ///< ms
    temporal_position, ///< counted
    acquisition_time,  ///< s of the day
    content_time,      ///< s of the day
    acquisition,       ///< counted
    instance,          ///< counted
};
constexpr std::size_t kDicomClocks = 7;

/// An image: a file, or a frame of one.
struct DicomImage {
    std::size_t file = 0;               ///< its number in the list of files
    std::uint32_t frame = 0;            ///< counted from 0
    std::optional<glm::dvec3> position; ///< [mm] of the middle of the first pixel, LPS
    std::array<glm::dvec3, 2> along{glm::dvec3(1, 0, 0),
                                    glm::dvec3(0, 1, 0)}; ///< its rows, columns
    std::optional<glm::dvec2> spacing; ///< [mm] between pixels of a row, between rows
    Scaling scaling;
    std::array<std::optional<double>, kDicomClocks> clocks{};
    /// Names and values that tell volumes apart: images of one volume have the same.
    std::vector<std::pair<std::string, std::string>> kind = {};
};

/// What all images of a file share.
struct DicomFile {
    std::uint32_t columns = 0, rows = 0, frames = 1;
    std::uint32_t samples = 1;   ///< samples per pixel: 1, or 3 for red, green and blue
    std::uint64_t pixels_at = 0; ///< [bytes] where they are stored as they are; 0: to be decoded
    bool big_endian = false;     ///< byte order of pixels that are stored as they are
    bool planar = false;         ///< samples lie apart, in each frame
    StoredType type = StoredType::u8;
    std::uint32_t bits = 8, lowest_bit = 0; ///< bits of a sample that hold its value
    std::string modality = {}, value_unit = {};
    double slice_spacing = 0;       ///< [mm]; 0: not said
    double temporal_resolution = 0; ///< [ms] between temporal positions; 0: not said
    std::vector<std::string> notes = {};
    std::vector<DicomImage> images = {}; ///< one for each frame; none: the file holds no image
};

/// @param number of the file in its list
/// @throws Error naming the file: no DICOM, damaged, pixels that are no scalars or colors, slices
///         of a mosaic
DicomFile read_dicom_header(const std::filesystem::path& path, std::size_t number);

} // namespace isochron::index
