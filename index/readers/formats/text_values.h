// Reads numbers that a file has as text, separated by blanks or commas.
#pragma once

#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/stored_scalar.h"

namespace isochron::index {

/// Reading forward parses each number once; going back starts from the beginning again.
class TextValues {
  public:
    /// @param offset of the first number in the file
    TextValues(const std::filesystem::path& path, std::uint64_t offset, StoredType type);

    /// Fills `out` with the values from number `first` on, in native byte order.
    /// @throws Error naming the file: too few numbers, or one that does not fit the type
    void read(std::uint64_t first, std::span<std::byte> out);
    /// Number of bytes after the last number that was read, without blanks at the end of the file.
    std::uint64_t rest();

  private:
    void rewind();
    /// The next number; empty at the end of the file. Valid until the next call.
    std::string_view next_word();
    /// Reads on, keeping what starts at `begin`. @return false at the end of the file
    bool refill(std::size_t begin);

    std::string name_;
    std::uint64_t bytes_; ///< length of the text
    StoredType type_;
    std::unique_ptr<DataStream> stream_;
    std::string text_;           ///< a part of the file
    std::size_t at_ = 0;         ///< in `text_`
    std::uint64_t taken_ = 0;    ///< bytes that have been read
    std::uint64_t position_ = 0; ///< number of the next value
};

} // namespace isochron::index
