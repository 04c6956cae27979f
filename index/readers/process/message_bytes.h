// Writes values as the bytes of a message, and reads them back: numbers, texts and structures.
#pragma once

#include "index/error.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace isochron::index {

template <class Enum>
constexpr Enum value_that_is_not_listed() = delete;
/// The last value of an enumeration whose values count from 0; greater numbers are invalid. Each
/// enumeration that crosses lists its own.
template <class Enum>
constexpr Enum kLastValue = value_that_is_not_listed<Enum>();

template <class T>
concept PlainValue = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// A structure that lists its fields.
template <class T>
concept WithFields = requires(T value) {
    value.fields();
};

/// Writes numbers as they are in memory: both ends are on one machine and of one build.
class MessageWriter {
  public:
    template <class... Values>
    void operator()(const Values&... values) {
        (put(values), ...);
    }
    std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    template <PlainValue T>
    void put(T value) {
        append(std::as_bytes(std::span(&value, 1)));
    }
    void put(const std::string& text) {
        put(std::uint64_t{text.size()});
        append(std::as_bytes(std::span(text)));
    }
    void put(const std::filesystem::path& path) { put(path.native()); }
    void put(const glm::dvec3& v) { (*this)(v.x, v.y, v.z); }
    void put(const glm::dmat3& m) { (*this)(m[0], m[1], m[2]); }
    template <class T, std::size_t kCount>
    void put(const std::array<T, kCount>& values) {
        for (const T& value : values)
            put(value);
    }
    template <WithFields T>
    void put(const T& value) {
        std::apply([this](const auto&... fields) { (*this)(fields...); }, value.fields());
    }
    template <class T>
    void put(const std::optional<T>& value) {
        put(value.has_value());
        if (value)
            put(*value);
    }
    template <class T>
    void put(const std::vector<T>& values) {
        put(std::uint64_t{values.size()});
        for (const T& value : values)
            put(value);
    }
    void append(std::span<const std::byte> bytes) {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }

    std::vector<std::byte> bytes_;
};

/// Trusts nothing in the message: a count that is too high costs no more memory than the message.
class MessageReader {
  public:
    explicit MessageReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    /// @throws Error when the message ends too early, or has an invalid value
    template <class... Values>
    void operator()(Values&... values) {
        (get(values), ...);
    }
    /// @throws Error when bytes are left
    void expect_end() const {
        if (!bytes_.empty())
            throw Error("a message that is longer than its content");
    }

  private:
    template <PlainValue T>
    void get(T& value) {
        std::array<std::byte, sizeof(T)> stored;
        const auto from = take(sizeof(T));
        std::copy(from.begin(), from.end(), stored.begin());
        if constexpr (std::is_same_v<T, bool>) {
            value = stored[0] == std::byte{1};
            if (!value && stored[0] != std::byte{0})
                throw Error("a message with a truth value that is neither");
        } else {
            value = std::bit_cast<T>(stored);
        }
        if constexpr (std::is_enum_v<T>)
            if (value > kLastValue<T>)
                throw Error("a message with a value that is none of its enumeration");
    }
    void get(std::string& text) {
        std::uint64_t size = 0;
        get(size);
        const auto from = take(size);
        text.assign(reinterpret_cast<const char*>(from.data()), from.size());
    }
    void get(std::filesystem::path& path) {
        std::string text;
        get(text);
        path = std::move(text);
    }
    void get(glm::dvec3& v) { (*this)(v.x, v.y, v.z); }
    void get(glm::dmat3& m) { (*this)(m[0], m[1], m[2]); }
    template <class T, std::size_t kCount>
    void get(std::array<T, kCount>& values) {
        for (T& value : values)
            get(value);
    }
    template <WithFields T>
    void get(T& value) {
        std::apply([this](auto&... fields) { (*this)(fields...); }, value.fields());
    }
    template <class T>
    void get(std::optional<T>& value) {
        bool there = false;
        get(there);
        if (!there)
            return;
        T given{};
        get(given);
        value = std::move(given);
    }
    template <class T>
    void get(std::vector<T>& values) {
        std::uint64_t count = 0;
        get(count);
        values.clear();
        for (; count > 0; --count) // the first value that is not there throws
            get(values.emplace_back());
    }
    std::span<const std::byte> take(std::uint64_t size) {
        if (size > bytes_.size())
            throw Error("a message that ends too early");
        const auto first = bytes_.first(size);
        bytes_ = bytes_.subspan(size);
        return first;
    }

    std::span<const std::byte> bytes_;
};

} // namespace isochron::index
