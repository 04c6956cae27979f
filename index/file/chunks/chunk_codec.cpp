// Packs chunks: takes differences of neighbors, puts bytes of equal weight together, then
// compresses.
#include "index/file/chunks/chunk_codec.h"

#include "index/file/chunks/chunk_differences.h"
#include "index/file/chunks/chunk_sums.h"
#include "index/file/chunks/packed_rows.h"

#include <lz4.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>

namespace isochron::index {
namespace {

enum class Form : unsigned { constant, stored, lz4, zstd };

constexpr unsigned kFormMask = 3, kShuffled = 32, kRows = 64, kKnownBits = 127;
/// Bits for differences along x, y and z.
constexpr std::array<unsigned, 3> kAlong{4, 8, 16};
/// The bits for differences along x; x and y; x, y and z.
constexpr std::array<unsigned, 3> kTried{4, 4 | 8, 4 | 8 | 16};
constexpr int kZstdLevel = 1;
/// A chunk that would shrink by less than 1 / kLeastGain is stored as it is, which reads faster.
constexpr std::size_t kLeastGain = 16;

using Size = std::array<std::uint32_t, 3>;

bool all_equal(std::span<const std::byte> values, std::size_t size) {
    return std::memcmp(values.data(), values.data() + size, values.size() - size) == 0;
}

/// Most bytes that the packed form may take.
std::size_t limit_of(std::size_t bytes) {
    return bytes - bytes / kLeastGain;
}

struct FreeUnpacker {
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

} // namespace

std::optional<Codec> codec_from_name(std::string_view name) {
    for (std::size_t i = 0; i < kCodecNames.size(); ++i)
        if (kCodecNames[i] == name)
            return static_cast<Codec>(i);
    return std::nullopt;
}

struct ChunkPacker::State {
    struct Free {
        void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
    };

    Codec codec;
    bool wide_rows;
    std::unique_ptr<ZSTD_CCtx, Free> zstd{ZSTD_createCCtx()};
    ChunkDifferences differences;
    std::vector<std::byte> packed; // kept for its memory

    /// Compresses into `packed`. @return its length; 0 if it would exceed the limit
    std::size_t press(Form form, std::span<const std::byte> bytes) {
        const std::size_t limit = limit_of(bytes.size());
        packed.resize(limit);
        if (form == Form::lz4) {
            const int size = LZ4_compress_default(
                reinterpret_cast<const char*>(bytes.data()), reinterpret_cast<char*>(packed.data()),
                static_cast<int>(bytes.size()), static_cast<int>(limit));
            return size > 0 ? static_cast<std::size_t>(size) : 0;
        }
        const std::size_t size = ZSTD_compressCCtx(zstd.get(), packed.data(), limit, bytes.data(),
                                                   bytes.size(), kZstdLevel);
        return ZSTD_isError(size) ? 0 : size;
    }
};

ChunkPacker::ChunkPacker(Codec codec, bool wide_rows) : state_(std::make_unique<State>()) {
    state_->codec = codec;
    state_->wide_rows = wide_rows;
}
ChunkPacker::~ChunkPacker() = default;
ChunkPacker::ChunkPacker(ChunkPacker&&) noexcept = default;

bool ChunkPacker::all_equal(ValueType type, std::span<const std::byte> values) {
    return index::all_equal(values, size_of(type));
}

void ChunkPacker::pack(ValueType type, const Size& size, std::span<const std::byte> values,
                       std::vector<std::byte>& out) {
    const auto put = [&](unsigned head, std::span<const std::byte> bytes) {
        out.push_back(static_cast<std::byte>(head));
        out.insert(out.end(), bytes.begin(), bytes.end());
    };
    const std::size_t word = size_of(type);
    if (index::all_equal(values, word))
        return put(static_cast<unsigned>(Form::constant), values.first(word));
    if (state_->codec != Codec::none) {
        const Form form = state_->codec == Codec::lz4 ? Form::lz4 : Form::zstd;
        const bool rows = state_->codec == Codec::fitting && (word == 1 || state_->wide_rows);
        const Differences found = state_->differences.find(size, word, values, rows);
        const auto bytes = state_->differences.shuffled();
        if (rows) {
            state_->packed.clear();
            if (word == 1) {
                pack_rows(bytes, state_->packed);
            } else if (found.bytes_of_rows <= limit_of(values.size())) {
                state_->packed.push_back(static_cast<std::byte>(found.shift));
                pack_word_rows(bytes, word, state_->packed);
            }
            if (!state_->packed.empty() && state_->packed.size() <= limit_of(values.size()))
                return put(static_cast<unsigned>(Form::stored) | kRows | kTried[found.axes - 1],
                           state_->packed);
            return put(static_cast<unsigned>(Form::stored), values);
        }
        const unsigned head =
            static_cast<unsigned>(form) | kTried[found.axes - 1] | (word > 1 ? kShuffled : 0);
        if (const std::size_t length = state_->press(form, bytes))
            return put(head, std::span(state_->packed).first(length));
    }
    put(static_cast<unsigned>(Form::stored), values);
}

bool unpack_chunk(ValueType type, const Size& size, std::span<const std::byte> packed,
                  std::span<std::byte> out) {
    if (packed.empty())
        return false;
    const auto head = std::to_integer<unsigned>(packed[0]);
    const std::span<const std::byte> body = packed.subspan(1);
    const std::size_t word = size_of(type);
    const Form form = static_cast<Form>(head & kFormMask);
    const bool rows = head & kRows;
    if (head & ~kKnownBits || (form <= Form::stored && head & ~kFormMask && !rows) ||
        (rows && (form != Form::stored || head & kShuffled)))
        return false;
    if (form == Form::constant) {
        if (body.size() != word)
            return false;
        for (std::size_t at = 0; at < out.size(); at += word)
            std::memcpy(out.data() + at, body.data(), word);
        return true;
    }
    if (form == Form::stored && !rows) {
        if (body.size() != out.size())
            return false;
        std::memcpy(out.data(), body.data(), out.size());
        return true;
    }
    thread_local std::vector<std::byte> shuffled;
    thread_local const std::unique_ptr<ZSTD_DCtx, FreeUnpacker> zstd(ZSTD_createDCtx());
    std::span<std::byte> plain = out;
    const bool wide_rows = rows && word > 1;
    if (head & kShuffled || wide_rows) {
        shuffled.resize(out.size());
        plain = shuffled;
    }
    unsigned shift = 0;
    if (wide_rows) {
        if (body.empty() || (shift = std::to_integer<unsigned>(body[0])) >= 8 * word ||
            !unpack_word_rows(body.subspan(1), word, plain))
            return false;
    } else if (rows) {
        if (!unpack_rows(body, plain))
            return false;
    } else if (form == Form::lz4) {
        const int length = LZ4_decompress_safe(
            reinterpret_cast<const char*>(body.data()), reinterpret_cast<char*>(plain.data()),
            static_cast<int>(body.size()), static_cast<int>(plain.size()));
        if (length < 0 || static_cast<std::size_t>(length) != plain.size())
            return false;
    } else if (ZSTD_decompressDCtx(zstd.get(), plain.data(), plain.size(), body.data(),
                                   body.size()) != plain.size()) {
        return false;
    }
    if (wide_rows)
        unshuffle_folded(plain, word, out.data());
    else if (head & kShuffled)
        unshuffle(plain, word, out.data());
    from_differences(type, size,
                     {(head & kAlong[0]) != 0, (head & kAlong[1]) != 0, (head & kAlong[2]) != 0},
                     out);
    if (shift > 0)
        shift_up(out, word, shift);
    return true;
}

} // namespace isochron::index
