// The interface for reading the bytes of an index: by position, never mapped.
#pragma once

#include "index/system/byte_range.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stop_token>
#include <string>

namespace isochron::index {

/// A file that is read by position, by any number of threads at once. A failure of the file or its
/// disk is an Error in one line, never a signal.
class ByteSource {
  public:
    virtual ~ByteSource() = default;
    virtual const std::string& name() const = 0;
    /// Its size [bytes] when it was opened.
    virtual std::uint64_t size() const = 0;
    /// Fills `out` with the bytes from `offset` on.
    /// @throws Error with the system's message, or saying that the file has become shorter
    void read(std::uint64_t offset, std::span<std::byte> out) const;
    /// Fills all of these, many in one call of the system where it can. @throws Error as `read`
    void read_each(std::span<const RangeRead> reads) const;
    /// Reads for a caller that reads much of the file in order, on one thread: what follows is read
    /// ahead.
    void read_in_order(std::uint64_t offset, std::span<std::byte> out) const;
    /// Bytes that have been read so far.
    std::uint64_t bytes_read() const { return bytes_read_; }
    /// Announces that these bytes are needed soon, so that the disk works on many requests at once.
    virtual void expect(std::uint64_t /*offset*/, std::uint64_t /*bytes*/) const {}
    /// Announces all of these, many in one call of the system where it can.
    virtual void expect_each(std::span<const ByteRange> ranges) const;
    /// Announces a range of bytes when nearly all of them are needed: reads the range from the disk in
    /// order, which takes less time than many requests, and waits until it has come. Never throws for
    /// the file or the disk: whoever reads the bytes gets the error. Returns early when stopped.
    virtual void fetch(std::uint64_t offset, std::uint64_t bytes,
                       const std::stop_token& /*stop*/) const {
        expect(offset, bytes);
    }

  protected:
    /// Reads some of the bytes. @return how many; 0 at the end of the file
    /// @throws Error naming the file
    virtual std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const = 0;
    virtual std::size_t read_some_in_order(std::uint64_t offset, std::span<std::byte> out) const {
        return read_some(offset, out);
    }
    /// Reads some of the bytes of each, together. What is left, or failed, is read by `read_some`.
    /// @param got as long as `reads`, all 0; gets the bytes read of each
    virtual void read_together(std::span<const RangeRead> /*reads*/,
                               std::span<std::size_t> /*got*/) const {}

  private:
    using Some = std::size_t (ByteSource::*)(std::uint64_t, std::span<std::byte>) const;
    void read_all(Some some, std::uint64_t offset, std::span<std::byte> out) const;

    mutable std::atomic<std::uint64_t> bytes_read_{0};
};

/// @throws Error: missing, unreadable, not a regular file
std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path);
/// A file of this machine. @param name by which errors call it
std::unique_ptr<ByteSource> open_local_bytes(const std::filesystem::path& path,
                                             const std::filesystem::path& name);

} // namespace isochron::index
