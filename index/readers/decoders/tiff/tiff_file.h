// A TIFF file as libtiff gives it: pages of one size, its errors as ours.
#pragma once

#include "index/readers/formats/stored_scalar.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

struct tiff;

namespace isochron::index {

/// What all pages of a volume share.
struct TiffShape {
    std::uint32_t width = 0, height = 0;
    std::uint32_t samples = 1; ///< samples per pixel
    StoredType type = StoredType::u8;
    bool half = false; ///< stored as float16, of type f32
    std::size_t stored_bytes() const { return half ? 2 : size_of(type); }
    bool operator==(const TiffShape&) const = default;
};

/// `640 x 480, u8 x 3`
std::string text(const TiffShape& shape);

class TiffFile {
  public:
    /// @throws Error naming the file: no TIFF, damaged, of a type that no volume can have
    explicit TiffFile(const std::filesystem::path& path);
    ~TiffFile();
    TiffFile(TiffFile&&) noexcept;
    TiffFile& operator=(TiffFile&&) = delete;

    const std::string& name() const { return name_; }
    /// Shape of the pages that are read: of the first, until `take_shape_of` another.
    const TiffShape& shape() const { return shape_; }
    void take_shape_of(std::size_t page);
    const std::string& description() const { return description_; }
    const std::string& software() const { return software_; }
    const std::string& lsm_record() const { return lsm_record_; } ///< tag 34412 of Zeiss LSM
    /// Bytes of the file, fewer where it ends.
    std::string bytes_at(std::uint64_t offset, std::size_t count) const;
    /// Pixels for each unit of length along x (axis 0) or y (axis 1); 0 if the file does not give
    /// it. The description may say what the unit is.
    double resolution(int axis) const { return resolution_[axis]; }
    /// Unit of the resolution: 1 none, 2 inch, 3 centimeter.
    unsigned resolution_unit() const { return resolution_unit_; }
    /// Tags of the first page that are not used.
    const std::vector<std::string>& notes() const { return notes_; }
    /// Number of pages, without thumbnails and masks. Of a large stack ImageJ describes only the
    /// first page, and appends the values of the others: see `take_appended`.
    std::size_t pages() const { return offsets_.size(); }
    /// Takes the values after the first page as further pages. @throws Error: the file is too short
    void take_appended(std::size_t pages);

    /// The values of one page as they are stored, in the machine's byte order.
    /// @param sample of each pixel, counted from 0
    /// @param out width * height values of the type
    /// @throws Error naming the file and the page: damaged, or of another shape
    void read(std::size_t page, std::uint32_t sample, std::span<std::byte> out);

  private:
    void list_pages();
    void note_tags();
    void read_stored(std::size_t page, std::uint32_t sample, std::span<std::byte> out);
    TiffShape shape_of_page() const;
    void go_to(std::size_t page);
    void read_appended(std::size_t page, std::span<std::byte> out);
    void read_strips(std::uint32_t sample, std::span<std::byte> out);
    void read_tiles(std::uint32_t sample, std::span<std::byte> out);
    [[noreturn]] void fail(const std::string& what) const;

    std::string name_;
    tiff* file_ = nullptr;
    TiffShape shape_;
    std::string description_, software_, lsm_record_;
    double resolution_[2]{};
    std::vector<std::uint64_t> offsets_; ///< offsets of the pages' directories
    std::size_t shaped_ = 0;             ///< page that has the shape
    std::uint64_t appended_at_ = 0;      ///< [bytes] where pages lie without directories; 0: none
    std::size_t page_ = 0;
    std::vector<std::byte> piece_;
    std::vector<std::byte> halves_;
    unsigned resolution_unit_ = 1;
    std::vector<std::string> notes_;
};

} // namespace isochron::index
