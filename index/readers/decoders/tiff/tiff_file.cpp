// Pages by libtiff.
#include "index/readers/decoders/tiff/tiff_file.h"

#include "index/error.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/half_float.h"
#include "index/readers/formats/unread_fields.h"
#include "index/system/input_file.h"

#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::size_t kMostPages = 1 << 20;

/// What libtiff said last; it has one handler for all files.
std::string& words_of_libtiff() {
    static std::string words;
    return words;
}

void keep_words(const char*, const char* format, std::va_list arguments) {
    char text[400]{};
    std::vsnprintf(text, sizeof text, format, arguments);
    words_of_libtiff() = text;
}

template <class T>
T field(TIFF* file, std::uint32_t tag, T otherwise) {
    T value = otherwise;
    return TIFFGetFieldDefaulted(file, tag, &value) ? value : otherwise;
}

std::optional<StoredType> sample_type(TIFF* file) {
    const auto bits = field<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE, 1);
    switch (field<std::uint16_t>(file, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT)) {
    case SAMPLEFORMAT_UINT:
    case SAMPLEFORMAT_VOID:
        if (bits <= 1)
            return StoredType::u8;
        return bits == 8    ? std::optional(StoredType::u8)
               : bits == 16 ? std::optional(StoredType::u16)
               : bits == 32 ? std::optional(StoredType::u32)
               : bits == 64 ? std::optional(StoredType::u64)
                            : std::nullopt;
    case SAMPLEFORMAT_INT:
        return bits == 8    ? std::optional(StoredType::i8)
               : bits == 16 ? std::optional(StoredType::i16)
               : bits == 32 ? std::optional(StoredType::i32)
               : bits == 64 ? std::optional(StoredType::i64)
                            : std::nullopt;
    case SAMPLEFORMAT_IEEEFP:
        return bits == 16 || bits == 32 ? std::optional(StoredType::f32)
               : bits == 64             ? std::optional(StoredType::f64)
                                        : std::nullopt;
    default: return std::nullopt;
    }
}

/// How well the compression of a page can do at best.
Compression at_best(TIFF* file) {
    switch (field<std::uint16_t>(file, TIFFTAG_COMPRESSION, COMPRESSION_NONE)) {
    case COMPRESSION_NONE: return Compression::none;
    case COMPRESSION_PACKBITS:
    case COMPRESSION_DEFLATE:
    case COMPRESSION_ADOBE_DEFLATE: return Compression::deflate;
    default: return Compression::bzip2;
    }
}

/// Half floats, which are widened to f32.
bool is_half(TIFF* file) {
    return field<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE, 1) == 16 &&
           field<std::uint16_t>(file, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT) ==
               SAMPLEFORMAT_IEEEFP;
}

bool is_bilevel(TIFF* file) {
    return field<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE, 1) == 1;
}

} // namespace

std::string text(const TiffShape& shape) {
    return fmt::format("{} x {}, {}{}", shape.width, shape.height,
                       shape.half ? "f16" : name_of(shape.type),
                       shape.samples == 1 ? "" : fmt::format(" x {}", shape.samples));
}

TiffFile::TiffFile(const std::filesystem::path& path) : name_(path.string()) {
    file_bytes(path);
    TIFFSetErrorHandler(keep_words);
    TIFFSetWarningHandler(nullptr);
    words_of_libtiff().clear();
    file_ = TIFFOpen(name_.c_str(), "r");
    if (!file_)
        fail("not TIFF, or damaged");
    try {
        shape_ = shape_of_page();
        const char* text = nullptr;
        if (TIFFGetField(file_, TIFFTAG_IMAGEDESCRIPTION, &text) && text)
            description_ = text;
        if (TIFFGetField(file_, TIFFTAG_SOFTWARE, &text) && text)
            software_ = text;
        note_tags();
        resolution_[0] = field<float>(file_, TIFFTAG_XRESOLUTION, 0);
        resolution_[1] = field<float>(file_, TIFFTAG_YRESOLUTION, 0);
        list_pages();
    } catch (...) {
        TIFFClose(file_);
        throw;
    }
}

TiffFile::TiffFile(TiffFile&& other) noexcept
    : name_(std::move(other.name_)), file_(std::exchange(other.file_, nullptr)),
      shape_(other.shape_), description_(std::move(other.description_)),
      software_(std::move(other.software_)), lsm_record_(std::move(other.lsm_record_)),
      resolution_{other.resolution_[0], other.resolution_[1]}, offsets_(std::move(other.offsets_)),
      shaped_(other.shaped_), appended_at_(other.appended_at_), page_(other.page_),
      piece_(std::move(other.piece_)), halves_(std::move(other.halves_)),
      resolution_unit_(other.resolution_unit_), notes_(std::move(other.notes_)) {}

TiffFile::~TiffFile() {
    if (file_)
        TIFFClose(file_);
}

void TiffFile::fail(const std::string& what) const {
    const std::string& words = words_of_libtiff();
    throw Error("{}: {}{}{}", name_, what, words.empty() ? "" : ": ", words);
}

TiffShape TiffFile::shape_of_page() const {
    TiffShape shape;
    shape.width = field<std::uint32_t>(file_, TIFFTAG_IMAGEWIDTH, 0);
    shape.height = field<std::uint32_t>(file_, TIFFTAG_IMAGELENGTH, 0);
    shape.samples = field<std::uint16_t>(file_, TIFFTAG_SAMPLESPERPIXEL, 1);
    const auto type = sample_type(file_);
    constexpr std::uint32_t kMostSamples = 1000;
    if (!type || (is_bilevel(file_) && shape.samples > 1))
        throw Error("{}: {} bits in format {}, expected integers of 1, 8, 16, 32 or 64 bits, f16, "
                    "f32 or f64",
                    name_, field<std::uint16_t>(file_, TIFFTAG_BITSPERSAMPLE, 1),
                    field<std::uint16_t>(file_, TIFFTAG_SAMPLEFORMAT, 1));
    shape.type = *type;
    shape.half = is_half(file_);
    if (shape.width == 0 || shape.height == 0 || shape.samples == 0 || shape.samples > kMostSamples)
        throw Error("{}: a page of {}", name_, text(shape));
    return shape;
}

void TiffFile::note_tags() {
    std::vector<std::string> unread;
    resolution_unit_ = field<std::uint16_t>(file_, TIFFTAG_RESOLUTIONUNIT, RESUNIT_NONE);
    if (const auto turned = field<std::uint16_t>(file_, TIFFTAG_ORIENTATION, 1); turned != 1)
        unread.push_back(
            fmt::format("Orientation {} (rows and columns are in the order of the file)", turned));
    switch (field<std::uint16_t>(file_, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK)) {
    case PHOTOMETRIC_MINISWHITE:
        unread.emplace_back("PhotometricInterpretation 0 (white is zero)");
        break;
    case PHOTOMETRIC_PALETTE: unread.emplace_back("ColorMap (values are its indices)"); break;
    default: break;
    }
    for (const auto& [tag, name] :
         {std::pair(TIFFTAG_XPOSITION, "XPosition"), std::pair(TIFFTAG_YPOSITION, "YPosition")}) {
        float position = 0;
        if (TIFFGetField(file_, static_cast<std::uint32_t>(tag), &position) && position != 0)
            unread.push_back(fmt::format("{} {}", name, position));
    }
    constexpr std::uint32_t kModelPixelScale = 33550, kModelTiepoint = 33922,
                            kModelTransformation = 34264, kNoData = 42113, kZeissLsm = 34412,
                            kImageJMetadata = 50839;
    for (const auto& [tag, name] :
         {std::pair(kModelPixelScale, "ModelPixelScale"),
          std::pair(kModelTiepoint, "ModelTiepoint"),
          std::pair(kModelTransformation, "ModelTransformation"), std::pair(kNoData, "GDAL_NODATA"),
          std::pair(kImageJMetadata, "IJMetadata (labels, overlays, properties)")})
        if (TIFFFindField(file_, tag, TIFF_ANY)) {
            // The library keeps tags that it does not know: their count, and where they are.
            std::uint32_t count = 0;
            const void* data = nullptr;
            if (TIFFGetField(file_, tag, &count, &data) && data)
                unread.emplace_back(name);
        }
    if (auto note = note_on_unread(unread))
        notes_.push_back(std::move(*note));
    if (TIFFFindField(file_, kZeissLsm, TIFF_ANY)) {
        std::uint32_t count = 0;
        const char* data = nullptr;
        constexpr std::uint32_t kMost = 1 << 16;
        if (TIFFGetField(file_, kZeissLsm, &count, &data) && data)
            lsm_record_.assign(data, std::min(count, kMost));
    }
}

std::string TiffFile::bytes_at(std::uint64_t offset, std::size_t count) const {
    const InputFile file(name_);
    const std::uint64_t size = file.size();
    std::string bytes(offset > size ? 0 : std::min<std::uint64_t>(count, size - offset), '\0');
    bytes.resize(file.read(offset, std::as_writable_bytes(std::span(bytes))));
    return bytes;
}

void TiffFile::list_pages() {
    std::size_t smaller = 0;
    double bytes = 0; // that the pages have; they may be of several images
    do {
        const auto kind = field<std::uint32_t>(file_, TIFFTAG_SUBFILETYPE, 0);
        if (!offsets_.empty() && (kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0) {
            ++smaller;
            continue;
        }
        offsets_.push_back(TIFFCurrentDirOffset(file_));
        bytes += static_cast<double>(field<std::uint32_t>(file_, TIFFTAG_IMAGEWIDTH, 0)) *
                 field<std::uint32_t>(file_, TIFFTAG_IMAGELENGTH, 0) *
                 field<std::uint16_t>(file_, TIFFTAG_SAMPLESPERPIXEL, 1) *
                 field<std::uint16_t>(file_, TIFFTAG_BITSPERSAMPLE, 1) / 8;
        if (offsets_.size() > kMostPages)
            throw Error("{}: more than {} pages", name_, kMostPages);
    } while (TIFFReadDirectory(file_));
    if (!words_of_libtiff().empty())
        fail(fmt::format("damaged behind page {}", offsets_.size()));
    if (smaller > 0)
        notes_.push_back(
            fmt::format("{} smaller pictures or masks beside the pages are left out", smaller));
    page_ = offsets_.size(); // none is current
    go_to(0);
    constexpr double kMost = 1e18; // beyond any file, within 64 bits
    expect_room(name_, 0, at_best(file_), static_cast<std::uint64_t>(std::min(bytes, kMost)));
}

void TiffFile::take_shape_of(std::size_t page) {
    words_of_libtiff().clear();
    if (!TIFFSetSubDirectory(file_, offsets_.at(page)))
        fail(fmt::format("page {} is damaged", page));
    shape_ = shape_of_page();
    shaped_ = page;
    page_ = offsets_.size(); // none is current
    go_to(page);
}

void TiffFile::take_appended(std::size_t pages) {
    go_to(0);
    const std::uint64_t* offsets = nullptr;
    const bool is_plain = at_best(file_) == Compression::none && shape_.samples == 1 &&
                          !is_bilevel(file_) && !TIFFIsTiled(file_) &&
                          TIFFGetField(file_, TIFFTAG_STRIPOFFSETS, &offsets) && offsets;
    const std::uint64_t page = std::uint64_t{shape_.width} * shape_.height * shape_.stored_bytes();
    if (!is_plain || pages > kMostPages)
        throw Error("{}: truncated: {} pages, its description has {}", name_, offsets_.size(),
                    pages);
    appended_at_ = offsets[0];
    const std::uint64_t size = file_bytes(name_);
    if (appended_at_ > size || (size - appended_at_) / page < pages)
        throw Error("{}: truncated: {} bytes, expected {} for the {} pages of its description",
                    name_, size, appended_at_ + page * pages, pages);
    offsets_.assign(pages, offsets_.front());
}

void TiffFile::go_to(std::size_t page) {
    if (page == page_)
        return;
    words_of_libtiff().clear();
    if (!TIFFSetSubDirectory(file_, offsets_.at(page)))
        fail(fmt::format("page {} is damaged", page));
    page_ = page;
    if (const TiffShape is = shape_of_page(); is != shape_)
        throw Error("{}: page {} is {}, page {} {}", name_, page, text(is), shaped_, text(shape_));
    if (field<std::uint16_t>(file_, TIFFTAG_COMPRESSION, COMPRESSION_NONE) == COMPRESSION_JPEG)
        TIFFSetField(file_, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
}

void TiffFile::read(std::size_t page, std::uint32_t sample, std::span<std::byte> out) {
    if (!shape_.half)
        return read_stored(page, sample, out);
    halves_.resize(out.size() / 2);
    read_stored(page, sample, halves_);
    widen_halves(halves_, out);
}

void TiffFile::read_stored(std::size_t page, std::uint32_t sample, std::span<std::byte> out) {
    if (appended_at_ > 0)
        return read_appended(page, out);
    go_to(page);
    words_of_libtiff().clear();
    if (TIFFIsTiled(file_))
        read_tiles(sample, out);
    else
        read_strips(sample, out);
}

void TiffFile::read_appended(std::size_t page, std::span<std::byte> out) {
    if (InputFile(name_).read(appended_at_ + page * out.size(), out) < out.size())
        throw Error("{}: page {} cannot be read", name_, page);
    const std::size_t size = shape_.stored_bytes();
    if (TIFFIsByteSwapped(file_))
        for (std::size_t i = 0; i + size <= out.size(); i += size)
            std::reverse(out.begin() + static_cast<std::ptrdiff_t>(i),
                         out.begin() + static_cast<std::ptrdiff_t>(i + size));
}

namespace {

/// One sample of each pixel of a row, or bits as bytes.
void take_row(const std::byte* row, std::uint32_t width, std::size_t size, std::uint32_t samples,
              std::uint32_t sample, bool bits, std::byte* out) {
    if (bits) {
        for (std::uint32_t x = 0; x < width; ++x)
            out[x] = (row[x / 8] >> (7 - x % 8)) & std::byte{1};
        return;
    }
    if (samples == 1) {
        std::memcpy(out, row, width * size);
        return;
    }
    for (std::uint32_t x = 0; x < width; ++x)
        std::memcpy(out + x * size, row + (std::size_t{x} * samples + sample) * size, size);
}

} // namespace

void TiffFile::read_strips(std::uint32_t sample, std::span<std::byte> out) {
    const std::uint32_t rows =
        std::min(field<std::uint32_t>(file_, TIFFTAG_ROWSPERSTRIP, shape_.height), shape_.height);
    const bool apart = field<std::uint16_t>(file_, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) ==
                       PLANARCONFIG_SEPARATE;
    const std::size_t size = shape_.stored_bytes(), row = shape_.width * size;
    const auto stored_row = static_cast<std::size_t>(TIFFScanlineSize64(file_));
    const std::uint32_t together = apart ? 1 : shape_.samples;
    const bool bits = is_bilevel(file_), as_they_are = together == 1 && !bits;
    if (rows == 0 || (as_they_are ? stored_row != row : stored_row == 0))
        fail(fmt::format("page {} is damaged: rows of {} bytes", page_, stored_row));
    piece_.resize(as_they_are ? 0 : stored_row * rows);
    for (std::uint32_t y = 0; y < shape_.height; y += rows) {
        const std::uint32_t count = std::min(rows, shape_.height - y);
        const std::span<std::byte> to = as_they_are ? out.subspan(y * row, count * row)
                                                    : std::span(piece_).first(count * stored_row);
        const auto got = TIFFReadEncodedStrip(
            file_, TIFFComputeStrip(file_, y, static_cast<std::uint16_t>(apart ? sample : 0)),
            to.data(), static_cast<tmsize_t>(to.size()));
        if (got != static_cast<tmsize_t>(to.size()))
            fail(fmt::format("page {} is damaged or truncated at row {}", page_, y));
        if (!as_they_are)
            for (std::uint32_t i = 0; i < count; ++i)
                take_row(&piece_[i * stored_row], shape_.width, size, together, sample, bits,
                         &out[(y + i) * row]);
    }
}

void TiffFile::read_tiles(std::uint32_t sample, std::span<std::byte> out) {
    const auto width = field<std::uint32_t>(file_, TIFFTAG_TILEWIDTH, 0),
               height = field<std::uint32_t>(file_, TIFFTAG_TILELENGTH, 0);
    const bool apart = field<std::uint16_t>(file_, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) ==
                       PLANARCONFIG_SEPARATE;
    const std::size_t size = shape_.stored_bytes(), row = shape_.width * size;
    const std::uint32_t together = apart ? 1 : shape_.samples;
    const bool bits = is_bilevel(file_);
    const std::uint64_t tile_bytes = TIFFTileSize64(file_), tile_row = TIFFTileRowSize64(file_);
    if (width == 0 || height == 0 || tile_row * height != tile_bytes ||
        tile_row < (bits ? (width + 7) / 8 : std::uint64_t{width} * together * size))
        fail(fmt::format("page {} is damaged: tiles of {} x {}", page_, width, height));
    piece_.resize(tile_bytes);
    for (std::uint32_t y = 0; y < shape_.height; y += height)
        for (std::uint32_t x = 0; x < shape_.width; x += width) {
            if (TIFFReadTile(file_, piece_.data(), x, y, 0,
                             static_cast<std::uint16_t>(apart ? sample : 0)) < 0)
                fail(fmt::format("page {} is damaged or truncated at {} {}", page_, x, y));
            const std::uint32_t columns = std::min(width, shape_.width - x);
            for (std::uint32_t i = 0; i < std::min(height, shape_.height - y); ++i)
                take_row(&piece_[i * tile_row], columns, size, together, sample, bits,
                         &out[(y + i) * row + x * size]);
        }
}

} // namespace isochron::index
