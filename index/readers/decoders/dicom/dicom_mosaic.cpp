// Reads what the private headers of mosaics say.
//
// Siemens: Li et al., "The first step for neuroimaging data analysis: DICOM to NIfTI conversion",
// J. Neurosci. Methods 264, 2016, doi:10.1016/j.jneumeth.2016.03.001; its header (CSA):
// https://nipy.org/nibabel/dicom/siemens_csa.html. United Imaging:
// https://github.com/rordenlab/dcm2niix/tree/master/UIH.
#include "index/readers/decoders/dicom/dicom_mosaic.h"

#include "index/error.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string_view>

namespace isochron::index {
namespace {

bool is_united_imaging(const DicomTags& root) {
    return root.text({0x0065, 0x0010}) == "Image Private Header" && root.items(kTileGroups) > 1;
}

/// Up to three numbers of an element of Siemens' header, which are text.
std::vector<double> numbers_in_csa(const std::string& header, std::string_view element) {
    constexpr std::size_t kItems = 84, kItem = 16; // [bytes] before the first, of the head of each
    std::vector<double> numbers;
    std::size_t at = header.find(std::string(element) + '\0');
    if (at == header.npos)
        return numbers;
    for (at += kItems; numbers.size() < 3 && at + kItem <= header.size();) {
        std::uint32_t bytes = 0;
        std::memcpy(&bytes, header.data() + at + 4, sizeof bytes);
        at += kItem;
        if (bytes == 0 || bytes > header.size() - at)
            break;
        numbers.push_back(std::strtod(header.substr(at, bytes).c_str(), nullptr));
        at += (bytes + 3) / 4 * 4;
    }
    return numbers;
}

} // namespace

void take_mosaic(const DicomTags& root, const std::string& name, DicomFile& file) {
    const bool of_siemens = root.text({0x0008, 0x0008}).find("MOSAIC") != std::string::npos;
    if (file.frames != 1 || (!of_siemens && !is_united_imaging(root)))
        return;
    const std::string header = root.bytes({0x0029, 0x0010, "SIEMENS CSA HEADER"});
    const std::string count = root.bytes({0x0019, 0x000a, "SIEMENS MR HEADER"}); // 16 bits
    const auto in_header = numbers_in_csa(header, "NumberOfImagesInMosaic");
    double tiles = 0;
    if (!of_siemens)
        tiles = static_cast<double>(root.items(kTileGroups));
    else if (!in_header.empty())
        tiles = in_header.front();
    else if (count.size() >= 2)
        tiles = static_cast<unsigned char>(count[0]) + 256.0 * static_cast<unsigned char>(count[1]);
    constexpr double kMost = 65536;
    const bool said = tiles >= 2 && tiles <= kMost;
    const double across = said ? std::ceil(std::sqrt(tiles)) : 1;
    const double down = of_siemens ? across : std::ceil(tiles / across);
    if (!said || std::fmod(file.columns, across) != 0 || std::fmod(file.rows, down) != 0)
        throw Error(
            "{}: a mosaic of slices, {} x {} pixels, that says {}: `dcm2niix {}` may convert it",
            name, file.columns, file.rows,
            said ? fmt::format("it has {} slices", tiles) : "nothing of their number",
            std::filesystem::path(name).parent_path().string());
    file.frames = static_cast<std::uint32_t>(tiles);
    file.tiles_across = static_cast<std::uint32_t>(across);
    file.tiles_down = static_cast<std::uint32_t>(down);
    file.columns /= file.tiles_across;
    file.rows /= file.tiles_down;
    // Slices follow each other along a normal of their own, which may be against that of the picture.
    const auto normal = numbers_in_csa(header, "SliceNormalVector");
    const auto along = root.numbers({0x0020, 0x0037});
    if (normal.size() == 3 && along.size() == 6) {
        const glm::dvec3 of_picture = glm::cross(glm::dvec3(along[0], along[1], along[2]),
                                                 glm::dvec3(along[3], along[4], along[5]));
        if (glm::dot(of_picture, glm::dvec3(normal[0], normal[1], normal[2])) < 0)
            file.slice_spacing = -file.slice_spacing;
    }
}

} // namespace isochron::index
