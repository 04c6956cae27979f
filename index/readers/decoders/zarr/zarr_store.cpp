// Folders and zip files.
//
// ".ZIP File Format Specification", PKWARE, version 6.3.10: sections 4.3.12 to 4.3.16 and 4.5.3.
#include "index/readers/decoders/zarr/zarr_store.h"

#include "index/error.h"
#include "index/system/input_file.h"

#include <zlib.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 30; ///< largest size of a value
constexpr std::size_t kMostNames = 100'000;

class FolderStore final : public ZarrStore {
  public:
    explicit FolderStore(const fs::path& path) : ZarrStore(path.string()), path_(path) {}

    using ZarrStore::read;
    bool read(const std::string& key, ZarrBytes& into) const override {
        const fs::path file = path_ / key;
        std::error_code error;
        if (!fs::is_regular_file(file, error))
            return false;
        const InputFile in(file);
        if (in.size() > kMostBytes)
            throw Error("{}: {} bytes, expected at most {}", file.string(), in.size(), kMostBytes);
        into.resize(in.size());
        into.resize(in.read(0, into));
        return true;
    }

    std::optional<std::uint64_t> size_of_value(const std::string& key) const override {
        const fs::path file = path_ / key;
        std::error_code error;
        if (!fs::is_regular_file(file, error))
            return std::nullopt;
        return InputFile(file).size();
    }

    void part(const std::string& key, std::uint64_t at, std::span<std::byte> into) const override {
        const fs::path file = path_ / key;
        const InputFile in(file);
        if (in.read(at, into) != into.size())
            throw Error("{}: truncated: {} bytes, expected {} at {}", file.string(), in.size(),
                        into.size(), at);
    }

    std::vector<std::string> names(const std::string& group) const override {
        std::vector<std::string> found;
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(path_ / group, error))
            if (found.size() < kMostNames)
                found.push_back(entry.path().filename().string());
        std::ranges::sort(found);
        return found;
    }

  private:
    fs::path path_;
};

struct ZipEntry {
    std::uint64_t at = 0, packed = 0, bytes = 0;
    std::uint32_t check = 0;
    std::uint16_t method = 0;
};

class ZipStore final : public ZarrStore {
  public:
    explicit ZipStore(const fs::path& path) : ZarrStore(path.string()), file_(path) {
        read_directory();
    }

    using ZarrStore::read;
    bool read(const std::string& key, ZarrBytes& into) const override {
        const auto found = entries_.find(key);
        if (found == entries_.end())
            return false;
        const ZipEntry& entry = found->second;
        check_size(entry, key);
        // The names and extra fields before the data may be others than in the directory.
        const std::string head = text_at(entry.at, 30);
        if (!head.starts_with("PK\3\4"))
            fail(key);
        const std::uint64_t data = entry.at + 30 + number(head, 26, 2) + number(head, 28, 2);
        ZarrBytes packed(entry.packed);
        if (file_.read(data, packed) != packed.size())
            fail(key);
        into = entry.method == 0 ? std::move(packed) : inflated(packed, entry, key);
        if (::crc32_z(0, reinterpret_cast<const Bytef*>(into.data()), into.size()) != entry.check)
            fail(key);
        return true;
    }

    std::optional<std::uint64_t> size_of_value(const std::string& key) const override {
        const auto found = entries_.find(key);
        if (found == entries_.end())
            return std::nullopt;
        check_size(found->second, key);
        return found->second.bytes;
    }

    /// A checksum covers a whole value, so the whole value is read once and kept.
    void part(const std::string& key, std::uint64_t at, std::span<std::byte> into) const override {
        if (kept_key_ != key) {
            kept_key_.clear();
            if (!read(key, kept_))
                kept_.clear();
            kept_key_ = key;
        }
        if (at > kept_.size() || into.size() > kept_.size() - at)
            fail(key);
        std::copy_n(kept_.begin() + static_cast<std::ptrdiff_t>(at), into.size(), into.begin());
    }

    std::vector<std::string> names(const std::string& group) const override {
        const std::string prefix = group.empty() ? "" : group + "/";
        std::set<std::string> found;
        for (auto entry = entries_.lower_bound(prefix);
             entry != entries_.end() && entry->first.starts_with(prefix); ++entry) {
            const std::string rest = entry->first.substr(prefix.size());
            found.insert(rest.substr(0, rest.find('/')));
            if (found.size() >= kMostNames)
                break;
        }
        return {found.begin(), found.end()};
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error("{}: damaged or truncated zip file: {}", name(), what);
    }

    /// So that no memory is taken for what cannot be there.
    void check_size(const ZipEntry& entry, const std::string& key) const {
        constexpr std::uint64_t kBest = 1032; // most that deflate can compress
        if (entry.bytes > kMostBytes || entry.packed > file_.size() ||
            (entry.method == 0 ? entry.packed != entry.bytes : entry.bytes / kBest > entry.packed))
            fail(key);
    }

    std::string text_at(std::uint64_t at, std::uint64_t size) const {
        std::string text(at > file_.size() ? 0 : std::min(size, file_.size() - at), '\0');
        text.resize(file_.read(at, std::as_writable_bytes(std::span(text))));
        return text;
    }

    std::uint64_t number(std::string_view text, std::size_t at, std::size_t size) const {
        if (at + size > text.size())
            fail("its directory");
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size; ++i)
            value |= std::uint64_t{static_cast<unsigned char>(text[at + i])} << 8 * i;
        return value;
    }

    void read_directory() {
        constexpr std::uint64_t kTail = 22 + 65535 + 20; // the longest comment, and zip64's locator
        const std::uint64_t from = file_.size() - std::min(kTail, file_.size());
        const std::string tail = text_at(from, kTail);
        const std::size_t end = tail.rfind("PK\5\6");
        if (end == std::string::npos)
            throw Error("{}: no zip file: it has no directory", name());
        std::uint64_t size = number(tail, end + 12, 4), at = number(tail, end + 16, 4);
        if (end >= 20 && tail.compare(end - 20, 4, "PK\6\7") == 0) { // zip64
            const std::string wide = text_at(number(tail, end - 20 + 8, 8), 56);
            size = number(wide, 40, 8);
            at = number(wide, 48, 8);
        }
        const std::string directory = text_at(at, std::min(size, file_.size()));
        for (std::size_t i = 0; i + 46 <= directory.size();)
            i += add(std::string_view(directory).substr(i));
    }

    /// @return [bytes] of the entry in the directory
    std::size_t add(std::string_view text) {
        if (!text.starts_with("PK\1\2"))
            fail("its directory");
        const std::size_t name_size = number(text, 28, 2), extra = number(text, 30, 2),
                          comment = number(text, 32, 2);
        ZipEntry entry{.at = number(text, 42, 4),
                       .packed = number(text, 20, 4),
                       .bytes = number(text, 24, 4),
                       .check = static_cast<std::uint32_t>(number(text, 16, 4)),
                       .method = static_cast<std::uint16_t>(number(text, 10, 2))};
        if (46 + name_size + extra > text.size())
            fail("its directory");
        take_wide(text.substr(46 + name_size, extra), entry);
        const std::string key(text.substr(46, name_size));
        if (entry.method != 0 && entry.method != 8)
            throw Error("{}: {} is packed by method {}, expected 0 or 8 (deflate)", name(), key,
                        entry.method);
        entries_[key] = entry;
        return 46 + name_size + extra + comment;
    }

    /// Numbers that do not fit 32 bits follow in an extra field, in this order.
    void take_wide(std::string_view extra, ZipEntry& entry) const {
        while (extra.size() >= 4) {
            const std::uint64_t kind = number(extra, 0, 2), size = number(extra, 2, 2);
            std::string_view field = extra.substr(4, size);
            for (std::uint64_t* value : {&entry.bytes, &entry.packed, &entry.at})
                if (kind == 1 && *value == 0xffff'ffffu && field.size() >= 8) {
                    *value = number(field, 0, 8);
                    field.remove_prefix(8);
                }
            extra.remove_prefix(std::min<std::size_t>(4 + size, extra.size()));
        }
    }

    ZarrBytes inflated(const ZarrBytes& packed, const ZipEntry& entry,
                       const std::string& key) const {
        ZarrBytes bytes(entry.bytes);
        z_stream stream{};
        if (::inflateInit2(&stream, -MAX_WBITS) != Z_OK)
            fail(key);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(packed.data()));
        stream.avail_in = static_cast<uInt>(std::min<std::uint64_t>(packed.size(), 0xffff'ffffu));
        stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
        stream.avail_out = static_cast<uInt>(std::min<std::uint64_t>(bytes.size(), 0xffff'ffffu));
        const int status = ::inflate(&stream, Z_FINISH);
        const bool whole = status == Z_STREAM_END && stream.total_out == bytes.size();
        ::inflateEnd(&stream);
        if (!whole)
            fail(key);
        return bytes;
    }

    InputFile file_;
    std::map<std::string, ZipEntry> entries_;
    mutable std::string kept_key_; ///< whose value `kept_` is
    mutable ZarrBytes kept_;
};

} // namespace

std::unique_ptr<ZarrStore> open_zarr_store(const fs::path& path) {
    std::error_code error;
    if (fs::is_directory(path, error))
        return std::make_unique<FolderStore>(path);
    return std::make_unique<ZipStore>(path);
}

} // namespace isochron::index
