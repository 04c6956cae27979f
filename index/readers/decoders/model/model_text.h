// The lines of a file of triangles in text, and their words.
#pragma once

#include "index/error.h"
#include "index/readers/formats/text_values.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace isochron::index {

class ModelText {
  public:
    ModelText(std::span<const std::byte> bytes, const std::string& name)
        : rest_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), name_(name) {}

    /// Goes to the next line, with or without a carriage return before its end.
    /// @return false at the end of the file
    bool next_line() {
        if (rest_.empty())
            return false;
        const std::size_t end = rest_.find('\n');
        words_ = line_ = rest_.substr(0, end);
        rest_.remove_prefix(std::min(line_.size() + 1, rest_.size()));
        ++number_;
        return true;
    }
    /// The next word of the line; empty at its end.
    std::string_view word() {
        constexpr std::string_view kBlanks = " \t\r\f\v";
        words_.remove_prefix(std::min(words_.find_first_not_of(kBlanks), words_.size()));
        const std::string_view found = words_.substr(0, words_.find_first_of(kBlanks));
        words_.remove_prefix(found.size());
        return found;
    }
    template <class T>
    T number(const char* what) {
        const std::string_view text = word();
        T value{};
        if (!parse_value(text, value))
            fail(fmt::format("expected {}, got {}", what,
                             text.empty() ? "the end of the line" : shortened(text)));
        return value;
    }
    std::string_view line() const { return line_; }
    std::uint64_t line_number() const { return number_; }
    /// What follows the line.
    std::string_view rest() const { return rest_; }
    [[noreturn]] void fail(const std::string& what) const {
        throw Error("{}: line {}: {}", name_, number_, what);
    }
    static std::string shortened(std::string_view text) {
        constexpr std::size_t kMost = 40;
        std::string kept;
        for (const char c : text.substr(0, kMost))
            kept += c >= ' ' && c < 0x7f ? c : '?';
        return kept + (text.size() > kMost ? "..." : "");
    }

  private:
    std::string_view rest_, line_, words_;
    std::uint64_t number_ = 0;
    std::string name_;
};

} // namespace isochron::index
