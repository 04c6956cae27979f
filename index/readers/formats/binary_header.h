// Fields of binary headers, at their byte offsets, in either byte order.
#pragma once

#include "index/readers/formats/text_header.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>

namespace isochron::index {

class BinaryHeader {
  public:
    /// @param head stays; it must be as long as the fields that are asked for
    /// @param swapped whether its byte order is not the machine's
    BinaryHeader(const std::string& head, bool swapped) : head_(head), swapped_(swapped) {}

    template <class T>
    T at(std::size_t offset) const {
        char bytes[sizeof(T)];
        std::memcpy(bytes, head_.data() + offset, sizeof(T));
        if (swapped_)
            std::reverse(bytes, bytes + sizeof(T));
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return value;
    }

    /// Up to its zero byte.
    std::string text(std::size_t offset, std::size_t most) const {
        const std::string whole = head_.substr(offset, most);
        return std::string(trimmed(whole.substr(0, whole.find('\0'))));
    }

  private:
    const std::string& head_;
    bool swapped_;
};

} // namespace isochron::index
