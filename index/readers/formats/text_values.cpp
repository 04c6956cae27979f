// Reads numbers as text, a part of the file at a time.
#include "index/readers/formats/text_values.h"

#include "index/error.h"
#include "index/readers/formats/text_header.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace isochron::index {
namespace {

constexpr std::string_view kBetween = " \t\r\n,";
constexpr std::size_t kLongestWord = 1024; ///< longest number; zeros can make one of any length
constexpr std::uint64_t kPart = 1 << 18;

Error not_a_value(std::string_view word, const std::string& file) {
    return Error("{}: `{}` is not a value of the array's type", file, excerpt(word));
}

} // namespace

TextValues::TextValues(const std::filesystem::path& path, std::uint64_t offset, StoredType type)
    : name_(path.string()), type_(type), stream_(open_data(path, offset, Compression::none)) {
    const std::uint64_t size = file_bytes(path);
    bytes_ = size > offset ? size - offset : 0;
}

void TextValues::rewind() {
    text_.clear();
    at_ = 0;
    taken_ = 0;
    position_ = 0;
}

bool TextValues::refill(std::size_t begin) {
    if (taken_ == bytes_)
        return false;
    text_.erase(0, begin);
    at_ -= begin;
    const std::size_t kept = text_.size();
    text_.resize(kept + std::min(kPart, bytes_ - taken_));
    stream_->read(taken_, std::as_writable_bytes(std::span(text_)).subspan(kept));
    taken_ += text_.size() - kept;
    return true;
}

std::string_view TextValues::next_word() {
    std::size_t begin = text_.find_first_not_of(kBetween, at_);
    while (begin == text_.npos) {
        at_ = text_.size();
        if (!refill(at_))
            return {};
        begin = text_.find_first_not_of(kBetween, at_);
    }
    at_ = begin;
    std::size_t end = text_.find_first_of(kBetween, begin);
    while (end == text_.npos) {
        if (text_.size() - begin > kLongestWord)
            throw not_a_value(std::string_view(text_).substr(begin), name_);
        if (!refill(begin)) {
            end = text_.size();
            break;
        }
        begin = at_;
        end = text_.find_first_of(kBetween, begin);
    }
    at_ = end;
    return std::string_view(text_).substr(begin, end - begin);
}

void TextValues::read(std::uint64_t first, std::span<std::byte> out) {
    if (first < position_)
        rewind();
    const std::uint64_t last = first + out.size() / size_of(type_);
    std::array<std::byte, 8> passed{};
    visit_stored_type(type_, [&]<class T>(std::type_identity<T>) {
        for (std::byte* to = out.data(); position_ < last; ++position_) {
            const std::string_view word = next_word();
            if (word.empty())
                throw Error("{}: truncated: {} values, expected {}", name_, position_, last);
            const bool wanted = position_ >= first;
            T value{};
            if (!parse_value(word, value))
                throw not_a_value(word, name_);
            std::memcpy(wanted ? to : passed.data(), &value, sizeof value);
            to += wanted ? sizeof(T) : 0;
        }
    });
}

std::uint64_t TextValues::rest() {
    const std::size_t length = next_word().size();
    if (length == 0)
        return 0;
    const std::uint64_t begin = taken_ - (text_.size() - at_) - length;
    std::uint64_t end = 0;
    do {
        const std::size_t last = text_.find_last_not_of(kBetween);
        if (last != text_.npos)
            end = taken_ - text_.size() + last + 1;
        at_ = text_.size();
    } while (refill(at_));
    rewind();
    return end - begin;
}

} // namespace isochron::index
