// Reads headers with GDCM, up to the pixels.
#include "index/readers/decoders/dicom/dicom_header.h"

#include "index/error.h"
#include "index/readers/decoders/dicom/dicom_frames.h"
#include "index/readers/decoders/dicom/dicom_mosaic.h"
#include "index/readers/decoders/dicom/dicom_place.h"
#include "index/readers/decoders/dicom/dicom_tags.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <gdcmReader.h>

#include <algorithm>
#include <cmath>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

const gdcm::Tag kPixelData(0x7fe0, 0x0010);

/// The values of pixels. @throws Error
void describe_pixels(const DicomTags& root, const std::string& name, DicomFile& file) {
    const auto whole = [&](const gdcm::Tag& tag, const char* what, double least, double most,
                           std::optional<double> otherwise = {}) {
        const auto number = root.number(tag);
        const double value = number.value_or(otherwise.value_or(-1));
        if (!(value >= least && value <= most) || value != std::floor(value))
            throw Error("{}: {} {}, expected {} to {}", name, what,
                        number ? fmt::format("{}", value) : "is not said", least, most);
        return static_cast<std::uint32_t>(value);
    };
    file.rows = whole({0x0028, 0x0010}, "Rows", 1, 65535);
    file.columns = whole({0x0028, 0x0011}, "Columns", 1, 65535);
    constexpr double kMostFrames = 1 << 20;
    file.frames = whole({0x0028, 0x0008}, "NumberOfFrames", 1, kMostFrames, 1);
    file.samples = whole({0x0028, 0x0002}, "SamplesPerPixel", 1, 3, 1);
    const std::uint32_t allocated = whole({0x0028, 0x0100}, "BitsAllocated", 1, 64);
    file.planar = whole({0x0028, 0x0006}, "PlanarConfiguration", 0, 1, 0) == 1;
    file.bits = whole({0x0028, 0x0101}, "BitsStored", 1, allocated, allocated);
    const std::uint32_t high =
        whole({0x0028, 0x0102}, "HighBit", file.bits - 1, allocated - 1, file.bits - 1);
    file.lowest_bit = high + 1 - file.bits;
    const bool with_sign = whole({0x0028, 0x0103}, "PixelRepresentation", 0, 1, 0) == 1;
    switch (allocated) {
    case 8: file.type = with_sign ? StoredType::i8 : StoredType::u8; break;
    case 16: file.type = with_sign ? StoredType::i16 : StoredType::u16; break;
    case 32: file.type = with_sign ? StoredType::i32 : StoredType::u32; break;
    default: throw Error("{}: BitsAllocated {}, expected 8, 16 or 32", name, allocated);
    }
    const std::string colors = root.text({0x0028, 0x0004});
    if (colors == "MONOCHROME1")
        file.notes.push_back("its low values are meant to be shown bright (MONOCHROME1)");
    else if (colors != "MONOCHROME2" && colors != "RGB" && !colors.empty())
        throw Error("{}: PhotometricInterpretation {}, expected MONOCHROME2 or RGB", name,
                    excerpt(colors));
    if (const auto padding = root.number({0x0028, 0x0120}))
        file.notes.push_back(fmt::format("its padding value {} counts as data", *padding));
}

/// @throws Error: there are fewer than the header says
void find_pixels(const fs::path& path, const gdcm::TransferSyntax& syntax, DicomFile& file) {
    if (syntax == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian)
        return;
    const bool big = syntax.GetSwapCode() == gdcm::SwapCode::BigEndian;
    const auto place = place_of_pixels(path, {!syntax.IsImplicit(), big});
    const std::string name = path.string();
    if (!place)
        throw Error("{}: no pixels in it, or damaged before them", name);
    if (place->packed || syntax.IsEncapsulated())
        return;
    const std::uint64_t expected =
        std::uint64_t{file.columns} * file.rows * file.samples * size_of(file.type) * file.frames;
    const std::uint64_t size = file_bytes(path);
    const std::uint64_t there = std::min(place->bytes, size - std::min(size, place->at));
    if (there < expected)
        throw Error("{}: truncated: its pixels have {} bytes, expected {}", name, there, expected);
    file.pixels_at = place->at;
    file.big_endian = big;
}

std::string unit_of(const DicomTags& root, const std::string& modality) {
    const gdcm::Tag of_frames(0x5200, 0x9230), of_all(0x5200, 0x9229);
    std::string unit;
    for (const gdcm::Tag& groups : {of_frames, of_all}) // real world values
        if (unit.empty())
            unit = root.within(groups, 0).within({0x0028, 0x9145}, 0).text({0x0028, 0x1054});
    for (const gdcm::Tag& tag : {gdcm::Tag(0x0028, 0x1054), gdcm::Tag(0x0054, 0x1001),
                                 gdcm::Tag(0x3004, 0x0002)}) // units of all, of PET, of dose
        if (unit.empty())
            unit = root.text(tag);
    if (unit.empty() && modality == "CT")
        unit = "HU";
    return unit == "US" || unit == "NONE" ? "" : unit;
}

/// Time between the volumes of an echo-planar scan, or of one that does not say how it was made.
double repetition_time(const DicomTags& root) {
    const std::string sequence = root.text({0x0018, 0x0020});
    const bool planar = sequence.empty() || sequence.find("EP") != sequence.npos;
    return planar ? root.number({0x0018, 0x0080}).value_or(0) : 0;
}

} // namespace

DicomFile read_dicom_header(const fs::path& path, std::size_t number) {
    const std::string name = path.string();
    gdcm::Reader reader;
    reader.SetFileName(path.c_str());
    if (!reader.ReadUpToTag(kPixelData, {kPixelData}))
        throw Error("{}: not DICOM, or damaged", name);
    const DicomTags root(reader.GetFile().GetDataSet(), name);
    DicomFile file;
    if (!root.number({0x0028, 0x0010}) && !root.number({0x0028, 0x0011}))
        return file; // a report, a directory, contours
    describe_pixels(root, name, file);
    find_pixels(path, reader.GetFile().GetHeader().GetDataSetTransferSyntax(), file);
    file.modality = root.text({0x0008, 0x0060});
    file.description = root.text({0x0008, 0x103e});
    file.comments = root.text({0x0020, 0x4000});
    file.value_unit = unit_of(root, file.modality);
    file.slice_spacing =
        root.number({0x0018, 0x0088}).value_or(root.number({0x0018, 0x0050}).value_or(0));
    file.temporal_resolution = root.number({0x0020, 0x0110}).value_or(0);
    file.temporal_positions = root.number({0x0020, 0x0105}).value_or(0);
    file.repetition_time = repetition_time(root);
    take_mosaic(root, name, file);
    file.images = images_of(root, file, number, name);
    return file;
}

} // namespace isochron::index
