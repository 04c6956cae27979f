// The interface for writing bytes to a file by position.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

/// A file that is written by position. Every function throws Error with the file's name and the
/// system's message (disk full, ...).
class ByteSink {
  public:
    virtual ~ByteSink() = default;
    virtual void write_at(std::uint64_t offset, std::span<const std::byte> bytes) = 0;
    /// Makes the disk begin to write, without waiting for it, so that a flush at the end of long
    /// work is short.
    virtual void begin_flush() {}
};

/// A file that grows while others read it: bytes after its end are written first and flushed, then
/// a last write makes them valid.
class GrowingSink : public ByteSink {
  public:
    /// Makes everything written so far safe from a power failure before anything that is written
    /// later.
    virtual void flush() = 0;
    /// Cuts the file to `bytes` if it is longer.
    virtual void cut(std::uint64_t bytes) = 0;
};

} // namespace isochron::index
