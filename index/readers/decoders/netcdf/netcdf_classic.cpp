// Lengths of classic NetCDF files, after "NetCDF Classic Format Specification" and "CDF-5 Format",
// https://docs.unidata.ucar.edu/nug/current/file_format_specifications.html.
#include "index/readers/decoders/netcdf/netcdf_classic.h"

#include "index/error.h"
#include "index/readers/formats/data_stream.h"
#include "index/system/mapped_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// The place of one variable's values in the file.
struct Extent {
    double begin = 0,
           /// Bytes of one record, if there are records; a false size may exceed 64 bits.
        bytes = 0;
    bool in_records = false;
};

class ClassicHeader {
  public:
    ClassicHeader(std::span<const std::byte> bytes, std::string file)
        : bytes_(bytes), file_(std::move(file)), version_(std::to_integer<int>(bytes[3])) {
        at_ = 4;
        records_ = size();
        read_dimensions();
        read_attributes();
        read_variables();
        expect_values();
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw Error("{}: {}", file_, what); }

    std::uint64_t number(std::size_t size) {
        if (size > bytes_.size() - at_)
            fail(fmt::format("truncated: its header does not end within {} bytes", bytes_.size()));
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size; ++i)
            value = value << 8 | std::to_integer<std::uint64_t>(bytes_[at_++]);
        return value;
    }
    std::uint64_t size() { return number(version_ == 5 ? 8 : 4); }

    void skip(std::uint64_t bytes) {
        const std::uint64_t padded = bytes + (4 - bytes % 4) % 4;
        if (bytes > bytes_.size() || padded > bytes_.size() - at_)
            fail(fmt::format("truncated: its header does not end within {} bytes", bytes_.size()));
        at_ += padded;
    }

    /// The number of items of a list. It may be false, so callers read the items one by one.
    std::uint64_t list(std::uint64_t tag) {
        const std::uint64_t found = number(4), items = size();
        if (found != tag && (found != 0 || items != 0))
            fail(fmt::format("damaged header: a list of {} items, marked {}, expected {}", items,
                             found, tag));
        return items;
    }

    std::uint64_t bytes_of_type() {
        constexpr std::array<std::uint64_t, 12> kBytes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
        const std::uint64_t type = number(4);
        if (type == 0 || type >= kBytes.size())
            fail(fmt::format("damaged header: type {}, expected 1 to {}", type, kBytes.size() - 1));
        return kBytes[type];
    }

    void read_dimensions() {
        for (std::uint64_t i = list(10); i > 0; --i) {
            skip(size());
            dimensions_.push_back(size());
        }
    }

    void read_attributes() {
        for (std::uint64_t i = list(12); i > 0; --i) {
            skip(size());
            const std::uint64_t each = bytes_of_type(), values = size();
            if (values > bytes_.size())
                fail(fmt::format("truncated: an attribute of {} values in {} bytes", values,
                                 bytes_.size()));
            skip(values * each);
        }
    }

    void read_variables() {
        for (std::uint64_t i = list(11); i > 0; --i) {
            skip(size());
            Extent extent{.begin = 0, .bytes = 1};
            for (std::uint64_t d = size(), first = d; d > 0; --d) {
                const std::uint64_t id = size();
                if (id >= dimensions_.size())
                    fail(fmt::format("damaged header: dimension {} of {}", id, dimensions_.size()));
                if (dimensions_[id] > 0)
                    extent.bytes *= static_cast<double>(dimensions_[id]);
                else if (d == first)
                    extent.in_records = true;
                else
                    fail("damaged header: an unlimited dimension that is not the slowest");
            }
            read_attributes();
            extent.bytes *= static_cast<double>(bytes_of_type());
            size(); // ignored: it follows from the dimensions
            extent.begin = static_cast<double>(number(version_ == 1 ? 4 : 8));
            extents_.push_back(extent);
        }
    }

    void expect_values() const {
        const auto padded = [](double bytes) { return std::ceil(bytes / 4) * 4; };
        double record = 0;
        std::size_t recorded = 0;
        for (const Extent& extent : extents_)
            if (extent.in_records) {
                record += padded(extent.bytes);
                ++recorded;
            }
        double end = 0;
        for (const Extent& extent : extents_) {
            if (extent.in_records && records_ == 0)
                continue;
            // If only one variable has records, they have no padding.
            const double stride = recorded == 1 ? extent.bytes : record;
            const double before =
                extent.in_records ? stride * static_cast<double>(records_ - 1) : 0.0;
            end = std::max(end, extent.begin + before + extent.bytes);
        }
        if (end > static_cast<double>(bytes_.size()))
            fail(fmt::format("truncated: {} bytes, its header says {:.0f}", bytes_.size(), end));
    }

    std::span<const std::byte> bytes_;
    std::string file_;
    int version_;
    std::size_t at_ = 0;
    std::uint64_t records_ = 0;
    std::vector<std::uint64_t> dimensions_; ///< 0: the unlimited one
    std::vector<Extent> extents_;
};

} // namespace

bool is_classic_netcdf(const fs::path& path) {
    const std::string head = head_of(path, 4);
    return head.size() == 4 && head.starts_with("CDF") &&
           (head[3] == 1 || head[3] == 2 || head[3] == 5);
}

void expect_whole_classic_netcdf(const fs::path& path) {
    const MappedFile file(path);
    ClassicHeader(file.bytes(), path.string());
}

} // namespace isochron::index
