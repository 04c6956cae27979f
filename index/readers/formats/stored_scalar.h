// Chooses one of the scalar arrays of a file, and converts it to values of a series.
#pragma once

#include "index/volume/volume_series.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace isochron::index {

/// The types of values in files; u32, i64 and u64 become f64 values, exactly or with an error.
enum class StoredType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::size_t size_of(StoredType type);
std::string_view name_of(StoredType type);
/// Reverses the bytes of each value. @param size [bytes] of a value
void swap_bytes(std::span<std::byte> values, std::size_t size);
StoredType stored_type_of(ValueType type);

/// Calls `f(std::type_identity<T>{})` with the C++ type of `type`.
template <class F>
decltype(auto) visit_stored_type(StoredType type, F&& f) {
    switch (type) {
    case StoredType::i8: return f(std::type_identity<std::int8_t>{});
    case StoredType::u8: return f(std::type_identity<std::uint8_t>{});
    case StoredType::i16: return f(std::type_identity<std::int16_t>{});
    case StoredType::u16: return f(std::type_identity<std::uint16_t>{});
    case StoredType::i32: return f(std::type_identity<std::int32_t>{});
    case StoredType::u32: return f(std::type_identity<std::uint32_t>{});
    case StoredType::i64: return f(std::type_identity<std::int64_t>{});
    case StoredType::u64: return f(std::type_identity<std::uint64_t>{});
    case StoredType::f32: return f(std::type_identity<float>{});
    case StoredType::f64: break;
    }
    return f(std::type_identity<double>{});
}

/// An array in a file. Tuples are stored x fastest, the components of a tuple together.
struct StoredArray {
    std::string name;
    std::optional<StoredType> type; ///< none: a type that no volume can have (strings, bits, ...)
    std::uint32_t components = 1;
    bool on_cells = false;    ///< one tuple per cell rather than per vertex
    bool gaps = false;        ///< values may be missing; only NaN can stand for these
    std::string shape = {};   ///< where a list of arrays has it: `64 x 64 x 32`
    bool maybe_steps = false; ///< the axis of components can be read as time instead
    bool by_pattern = false;  ///< a pattern of names takes arrays that match as the steps of one
};

/// An array, or one component of it, or its magnitude.
struct ChosenScalar {
    static constexpr std::uint32_t kMagnitude = ~0u;

    StoredArray array;
    std::uint32_t component = 0;           ///< or kMagnitude
    std::vector<std::string> offered = {}; ///< what there was to choose from, with types

    /// Type of the values: the stored type if a series can have it. Means over cells, magnitudes
    /// and arrays with gaps are f32 if the stored type is f32 or an integer of up to 16 bits, else
    /// f64.
    ValueType value_type() const;
    std::string label() const;              ///< `speed`, `velocity.2`, `velocity.magnitude`
    std::vector<std::string> notes() const; ///< what was done to the stored values
    /// Says which array it is, of which ones, and of which type.
    void describe(SeriesInfo& info) const;
};

/// Picks the array and component that `options` name; a single array needs no name. Point data win
/// over cell data with the same name.
/// @throws Error listing the arrays, with type and components, if the choice is ambiguous or wrong
ChosenScalar choose_scalar(std::span<const StoredArray> arrays, const ReadOptions& options,
                           const std::string& file);

/// Converts the tuples of one step (native byte order) to values at the vertices: all of them, or,
/// if the array is on vertices, a part of them.
/// @param missing a number for each tuple, not 0 if its value is missing; or empty. Only for arrays
///        with `gaps`
/// @throws Error naming `file` when a 64-bit integer has no exact f64
void convert(const ChosenScalar& chosen, std::span<const std::byte> tuples, const Grid& grid,
             std::span<std::byte> out, const std::string& file,
             std::span<const std::uint8_t> missing = {});

/// As `convert`, for arrays on vertices whose components are stored apart. Calls `load` for the
/// chosen component, or for every component from 0 on if the magnitude is chosen; `plane` has room
/// for one stored value (native byte order) at each vertex of `grid`.
void convert_planes(
    const ChosenScalar& chosen, const Grid& grid, std::span<std::byte> out, const std::string& file,
    const std::function<void(std::size_t component, std::span<std::byte> plane)>& load);

} // namespace isochron::index
