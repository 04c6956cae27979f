// Text, base64, raw bytes and packed blocks.
#include "index/readers/decoders/vtk/vti_values.h"

#include "index/error.h"
#include "index/readers/formats/text_header.h"
#include "index/readers/formats/text_values.h"

#include <fmt/format.h>
#include <lz4.h>
#include <lzma.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <vector>

namespace isochron::index {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

[[noreturn]] void fail(const std::string& where, std::string_view what) {
    throw Error("{}: {}", where, what);
}

/// Bytes one after another, as they are or in base64.
class StoredBytes {
  public:
    StoredBytes(const VtiPlace& place, const std::string& where)
        : rest_(place.stored), raw_(place.as == VtiPlace::As::raw), where_(where) {}

    void take(std::span<std::byte> out) {
        if (raw_) {
            const std::string_view bytes = take_raw(out.size());
            std::memcpy(out.data(), bytes.data(), out.size());
            return;
        }
        for (std::byte& byte : out) {
            if (next_ == count_)
                decode_group();
            byte = group_[next_++];
        }
    }

    /// The next bytes, decoded into `scratch` where they are not stored as they are.
    std::span<const std::byte> view(std::size_t count, std::vector<std::byte>& scratch) {
        if (raw_)
            return std::as_bytes(std::span(take_raw(count)));
        expect(count);
        scratch.resize(count);
        take(scratch);
        return scratch;
    }

    /// Checks that so many bytes may be left. @throws Error
    void expect(std::uint64_t count) const {
        if (count > rest_.size() + group_.size())
            truncated();
    }

  private:
    [[noreturn]] void truncated() const { fail(where_, "truncated: it ends within its values"); }

    std::string_view take_raw(std::size_t count) {
        if (count > rest_.size())
            truncated();
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }

    /// -1 for blanks, -2 for `=`, -3 for what no base64 has.
    static const std::array<std::int8_t, 256>& digits() {
        static const auto kDigits = [] {
            std::array<std::int8_t, 256> digits{};
            digits.fill(-3);
            constexpr std::string_view kAlphabet =
                "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
            for (std::size_t i = 0; i < kAlphabet.size(); ++i)
                digits[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::int8_t>(i);
            for (const char blank : kBlanks)
                digits[static_cast<unsigned char>(blank)] = -1;
            digits['='] = -2;
            return digits;
        }();
        return kDigits;
    }

    /// Four digits are three bytes; padded, they are two or one, and the next group goes on.
    void decode_group() {
        const auto& digit = digits();
        std::uint32_t bits = 0;
        int read = 0, padding = 0;
        while (read < 4) {
            if (rest_.empty())
                truncated();
            const std::int8_t value = digit[static_cast<unsigned char>(rest_.front())];
            if (value == -3 || (value >= 0 && padding > 0) || (value == -2 && read < 2))
                rest_.front() == '<' ? truncated() : fail(where_, "damaged: its base64 ends early");
            rest_.remove_prefix(1);
            if (value == -1)
                continue;
            padding += value == -2;
            bits = bits << 6 | static_cast<std::uint32_t>(std::max<int>(value, 0));
            ++read;
        }
        count_ = 3 - padding;
        next_ = 0;
        for (int i = 0; i < 3; ++i)
            group_[i] = static_cast<std::byte>(bits >> (16 - 8 * i) & 0xff);
    }

    std::string_view rest_;
    bool raw_;
    const std::string& where_;
    std::array<std::byte, 3> group_{};
    int next_ = 0, count_ = 0; ///< bytes of the group: taken, and all
};

std::uint64_t take_count(StoredBytes& bytes, const VtiEncoding& encoding) {
    std::array<std::byte, 8> stored{};
    const std::span<std::byte> count(stored.data(), encoding.wide_header ? 8 : 4);
    bytes.take(count);
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < count.size(); ++i)
        number = number << 8 | std::to_integer<std::uint64_t>(
                                   count[encoding.big_endian ? i : count.size() - 1 - i]);
    return number;
}

/// @return whether a block has become exactly `out`
bool unpack(BlockPacking packing, std::span<const std::byte> block, std::span<std::byte> out) {
    switch (packing) {
    case BlockPacking::zlib: {
        uLongf size = out.size();
        return ::uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                            reinterpret_cast<const Bytef*>(block.data()), block.size()) == Z_OK &&
               size == out.size();
    }
    case BlockPacking::lz4:
        return block.size() <= INT32_MAX && out.size() <= INT32_MAX &&
               LZ4_decompress_safe(reinterpret_cast<const char*>(block.data()),
                                   reinterpret_cast<char*>(out.data()),
                                   static_cast<int>(block.size()),
                                   static_cast<int>(out.size())) == static_cast<int>(out.size());
    case BlockPacking::lzma: {
        std::uint64_t memory = std::uint64_t{256} << 20;
        std::size_t in = 0, done = 0;
        return ::lzma_stream_buffer_decode(
                   &memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(block.data()), &in,
                   block.size(), reinterpret_cast<std::uint8_t*>(out.data()), &done,
                   out.size()) == LZMA_OK &&
               done == out.size();
    }
    case BlockPacking::none: break;
    }
    return false;
}

/// Blocks behind their number, the size of each, that of the last (0: as the others), and the packed
/// size of each. What follows the values that are wanted is not unpacked.
void read_blocks(StoredBytes& bytes, const VtiEncoding& encoding, std::span<std::byte> out,
                 const std::string& where) {
    const std::uint64_t blocks = take_count(bytes, encoding), size = take_count(bytes, encoding),
                        last = take_count(bytes, encoding);
    if (last > size)
        fail(where, fmt::format("damaged: its last block has {} bytes, the others {}", last, size));
    // Each block has a size in the file, so that their number cannot be wrong by much.
    const std::uint64_t width = encoding.wide_header ? 8 : 4;
    if (blocks > std::numeric_limits<std::uint64_t>::max() / width)
        fail(where, "damaged: its number of blocks is no such number");
    bytes.expect(blocks * width);
    std::vector<std::uint64_t> packed(blocks);
    for (std::uint64_t& one : packed)
        one = take_count(bytes, encoding);
    std::vector<std::byte> scratch, surplus;
    std::size_t done = 0;
    for (std::uint64_t i = 0; i < blocks && done < out.size(); ++i) {
        bytes.expect(packed[i]);
        const std::uint64_t whole = i + 1 == blocks && last != 0 ? last : size;
        constexpr std::uint64_t kSmall = 1 << 10;
        if (whole / best_ratio(encoding.packing) > packed[i] + kSmall)
            fail(where,
                 fmt::format("damaged: a block of {} bytes cannot become {}", packed[i], whole));
        const auto block = bytes.view(packed[i], scratch);
        const std::size_t wanted = std::min<std::uint64_t>(whole, out.size() - done);
        std::span<std::byte> into = out.subspan(done, wanted);
        if (wanted < whole) {
            surplus.resize(whole);
            into = surplus;
        }
        if (!unpack(encoding.packing, block, into))
            fail(where, fmt::format("damaged: block {} of {} cannot be unpacked", i, blocks));
        if (wanted < whole)
            std::memcpy(out.data() + done, surplus.data(), wanted);
        done += wanted;
    }
    if (done < out.size())
        fail(where,
             fmt::format("truncated: its blocks hold {} bytes, expected {}", done, out.size()));
}

template <class T>
void read_text(std::string_view text, std::span<T> out, const std::string& where) {
    text = text.substr(0, text.find('<'));
    std::size_t at = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        at = std::min(text.find_first_not_of(kBlanks, at), text.size());
        const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
        if (at == end)
            fail(where, fmt::format("truncated: {} values, expected {}", i, out.size()));
        if (!parse_value(text.substr(at, end - at), out[i]))
            fail(where, fmt::format("value {}: `{}` is not a number of its type", i,
                                    excerpt(text.substr(at, end - at))));
        at = end;
    }
}

} // namespace

std::uint64_t best_ratio(BlockPacking packing) {
    switch (packing) {
    case BlockPacking::none: break;
    case BlockPacking::zlib: return 1'032;
    case BlockPacking::lz4: return 255;
    case BlockPacking::lzma: return 10'000;
    }
    return 1;
}

void read_vti_values(const VtiPlace& place, const VtiEncoding& encoding, StoredType type,
                     std::span<std::byte> out, const std::string& where) {
    if (place.as == VtiPlace::As::text)
        return visit_stored_type(type, [&]<class T>(std::type_identity<T>) {
            read_text(place.stored,
                      std::span(reinterpret_cast<T*>(out.data()), out.size() / sizeof(T)), where);
        });
    StoredBytes bytes(place, where);
    if (encoding.packing == BlockPacking::none) {
        const std::uint64_t stated = take_count(bytes, encoding);
        if (stated < out.size())
            fail(where, fmt::format("truncated: {} bytes, expected {}", stated, out.size()));
        bytes.take(out);
    } else {
        read_blocks(bytes, encoding, out, where);
    }
    if (encoding.big_endian)
        swap_bytes(out, size_of(type));
}

std::span<const std::byte> plain_vti_values(const VtiPlace& place, const VtiEncoding& encoding,
                                            StoredType type, std::uint64_t bytes,
                                            const std::string& where) {
    if (place.as != VtiPlace::As::raw || encoding.packing != BlockPacking::none ||
        (encoding.big_endian && size_of(type) > 1))
        return {};
    StoredBytes stored(place, where);
    const std::uint64_t stated = take_count(stored, encoding);
    if (stated < bytes)
        fail(where, fmt::format("truncated: {} bytes, expected {}", stated, bytes));
    std::vector<std::byte> unused;
    return stored.view(bytes, unused);
}

} // namespace isochron::index
