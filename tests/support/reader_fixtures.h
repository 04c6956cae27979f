// Helpers of the reader tests: temporary folders, small volumes, and the message of an Error.
#pragma once

#include "index/error.h"
#include "index/volume/volume_series.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <stdlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

using test_support::TestFolder;

inline std::string read_file(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// first, first + 1, ...
template <class T>
std::vector<T> ramp(std::size_t count, T first = T{}) {
    std::vector<T> values(count);
    std::iota(values.begin(), values.end(), first);
    return values;
}

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

/// The values' bytes in memory.
template <class T>
std::string text_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

inline std::size_t part_of(std::size_t size, double part) {
    return static_cast<std::size_t>(part * static_cast<double>(size));
}

template <class T>
constexpr ValueType value_type_of() {
    if constexpr (std::is_same_v<T, std::int8_t>)
        return ValueType::i8;
    else if constexpr (std::is_same_v<T, std::uint8_t>)
        return ValueType::u8;
    else if constexpr (std::is_same_v<T, std::int16_t>)
        return ValueType::i16;
    else if constexpr (std::is_same_v<T, std::uint16_t>)
        return ValueType::u16;
    else if constexpr (std::is_same_v<T, std::int32_t>)
        return ValueType::i32;
    else if constexpr (std::is_same_v<T, float>)
        return ValueType::f32;
    else
        return ValueType::f64;
}

template <class T>
std::vector<T> values_of(VolumeSeries& series, std::size_t step) {
    EXPECT_EQ(series.info().type, value_type_of<T>());
    std::vector<T> values(series.info().step_bytes() / sizeof(T));
    series.read(step, std::as_writable_bytes(std::span(values)));
    return values;
}

/// The message of the Error that `f` throws; fails the test and returns empty if it throws none.
template <class F>
std::string error_of(F&& f) {
    try {
        f();
    } catch (const Error& error) {
        std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << "more than one line: " << message;
        return message;
    }
    ADD_FAILURE() << "no Error thrown";
    return {};
}

} // namespace isochron::index
