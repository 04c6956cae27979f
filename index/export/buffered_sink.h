// Writes a file from its beginning to its end, text and numbers, in large pieces.
#pragma once

#include "index/system/byte_sink.h"
#include "index/system/scratch_file.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>

namespace isochron::index {

/// Not thread-safe. Functions throw as the sink's do.
class BufferedSink {
  public:
    /// @param sink outlives this, is written from byte 0 on
    explicit BufferedSink(ByteSink& sink)
        : sink_(sink), bytes_(std::make_unique_for_overwrite<std::byte[]>(kAtOnce + kMost)) {}

    void text(std::string_view text) { bytes(std::as_bytes(std::span(text))); }
    /// Numbers are little-endian.
    template <class T>
        requires std::is_trivially_copyable_v<T>
    void put(const T& value) {
        static_assert(std::endian::native == std::endian::little && sizeof(T) <= kMost);
        std::memcpy(&bytes_[waiting_], &value, sizeof value);
        waiting_ += sizeof value;
        if (waiting_ >= kAtOnce)
            flush();
    }
    void bytes(std::span<const std::byte> added);
    /// The first bytes of a file.
    void copy(const ScratchFile& file, std::uint64_t count);
    /// Zeros up to the next multiple of `alignment`.
    void align(std::size_t alignment);
    /// What was written so far gets to the sink.
    void flush();
    std::uint64_t size() const { return at_ + waiting_; }

  private:
    static constexpr std::size_t kAtOnce = std::size_t{1} << 20, kMost = 256;
    ByteSink& sink_;
    std::uint64_t at_ = 0;
    std::unique_ptr<std::byte[]> bytes_;
    std::size_t waiting_ = 0; ///< bytes that the sink does not have yet
};

} // namespace isochron::index
