// Walks over the elements of a data set.
//
// https://dicom.nema.org/medical/dicom/current/output/chtml/part05/chapter_7.html
#include "index/readers/decoders/dicom/dicom_place.h"

#include "index/system/input_file.h"

#include <array>
#include <cstddef>
#include <string_view>

namespace isochron::index {
namespace {

constexpr std::uint32_t kNoLength = 0xffffffff;
constexpr std::uint32_t kPixels = 0x7fe00010, kItem = 0xfffee000, kItemEnd = 0xfffee00d,
                        kSequenceEnd = 0xfffee0dd;

struct Element {
    std::uint32_t tag = 0, length = 0;
    std::uint64_t value_at = 0;
    bool unknown = false; ///< the element has the kind UN: what is in it is written without kinds
};

class Walk {
  public:
    explicit Walk(const std::filesystem::path& path) : file_(path) {}

    std::optional<PixelPlace> pixels(const DicomCoding& coding) {
        std::uint64_t at = 0;
        std::array<std::byte, 4> letters{};
        constexpr std::uint64_t kPreamble = 128;
        if (file_.read(kPreamble, letters) == letters.size() &&
            std::string_view(reinterpret_cast<const char*>(letters.data()), 4) == "DICM")
            at = kPreamble + letters.size();
        for (auto meta = element(at, {}); meta && meta->tag >> 16 == 2; meta = element(at, {}))
            at = meta->value_at + meta->length;
        while (const auto next = element(at, coding)) {
            if (next->tag == kPixels)
                return PixelPlace{next->value_at, next->length, next->length == kNoLength};
            const auto end = end_of(*next, coding, 0);
            if (!end || *end <= at)
                break;
            at = *end;
        }
        return std::nullopt;
    }

  private:
    /// @return none: the end of the file
    std::optional<Element> element(std::uint64_t at, const DicomCoding& coding) const {
        std::array<std::byte, 12> bytes{};
        const std::size_t got = file_.read(at, bytes);
        const auto number = [&](std::size_t first, std::size_t size) {
            std::uint32_t value = 0;
            for (std::size_t i = 0; i < size; ++i)
                value |= std::to_integer<std::uint32_t>(
                             bytes[coding.big_endian ? first + size - 1 - i : first + i])
                         << 8 * i;
            return value;
        };
        if (got < 8)
            return std::nullopt;
        Element found{.tag = number(0, 2) << 16 | number(2, 2)};
        const std::string_view kind(reinterpret_cast<const char*>(bytes.data()) + 4, 2);
        constexpr std::string_view kLong = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";
        found.unknown = coding.with_kinds && kind == "UN";
        if (!coding.with_kinds || found.tag >> 16 == 0xfffe) {
            found.length = number(4, 4);
            found.value_at = at + 8;
        } else if (const auto found_at = kLong.find(kind);
                   found_at != kLong.npos && found_at % 3 == 0) {
            if (got < 12)
                return std::nullopt;
            found.length = number(8, 4);
            found.value_at = at + 12;
        } else {
            found.length = number(6, 2);
            found.value_at = at + 8;
        }
        return found;
    }

    /// The place behind an element. @return none: it has no end
    std::optional<std::uint64_t> end_of(const Element& of, const DicomCoding& coding,
                                        int depth) const {
        constexpr int kDeepest = 32;
        if (of.length != kNoLength)
            return of.value_at + of.length;
        if (depth > kDeepest)
            return std::nullopt;
        const DicomCoding within = of.unknown ? DicomCoding{false, false} : coding;
        const std::uint32_t last = of.tag == kItem ? kItemEnd : kSequenceEnd;
        std::uint64_t at = of.value_at;
        while (const auto next = element(at, within)) {
            if (next->tag == last)
                return next->value_at;
            const auto end = end_of(*next, within, depth + 1);
            if (!end || *end <= at)
                return std::nullopt;
            at = *end;
        }
        return std::nullopt;
    }

    InputFile file_;
};

} // namespace

std::optional<PixelPlace> place_of_pixels(const std::filesystem::path& path,
                                          const DicomCoding& coding) {
    return Walk(path).pixels(coding);
}

} // namespace isochron::index
