// Reading of values that lie as one plain array.
#include "index/formats/stored_file.h"

#include "index/error.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

namespace isochron::index {
namespace {

static_assert(std::endian::native == std::endian::little);

void swap_bytes(std::span<std::byte> values, std::size_t size) {
    for (std::size_t i = 0; i + size <= values.size(); i += size)
        std::reverse(values.begin() + i, values.begin() + i + size);
}

template <class T>
void parse_number(std::string_view word, std::byte* out, const std::string& file) {
    T value{};
    if (word.starts_with('+'))
        word.remove_prefix(1);
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failure != std::errc{} || end != word.data() + word.size())
        throw Error(fmt::format("{}: `{}` is not a value of the array's type", file, word));
    std::memcpy(out, &value, sizeof value);
}

void parse_number(StoredType type, std::string_view word, std::byte* out, const std::string& file) {
    switch (type) {
    case StoredType::i8: {
        std::int16_t wide = 0; // from_chars would read a character
        parse_number<std::int16_t>(word, reinterpret_cast<std::byte*>(&wide), file);
        if (wide < -128 || wide > 127)
            throw Error(fmt::format("{}: `{}` is not a value of the array's type", file, word));
        *out = static_cast<std::byte>(static_cast<std::int8_t>(wide));
        return;
    }
    case StoredType::u8: {
        std::uint16_t wide = 0;
        parse_number<std::uint16_t>(word, reinterpret_cast<std::byte*>(&wide), file);
        if (wide > 255)
            throw Error(fmt::format("{}: `{}` is not a value of the array's type", file, word));
        *out = static_cast<std::byte>(wide);
        return;
    }
    case StoredType::i16: return parse_number<std::int16_t>(word, out, file);
    case StoredType::u16: return parse_number<std::uint16_t>(word, out, file);
    case StoredType::i32: return parse_number<std::int32_t>(word, out, file);
    case StoredType::u32: return parse_number<std::uint32_t>(word, out, file);
    case StoredType::i64: return parse_number<std::int64_t>(word, out, file);
    case StoredType::u64: return parse_number<std::uint64_t>(word, out, file);
    case StoredType::f32: return parse_number<float>(word, out, file);
    case StoredType::f64: return parse_number<double>(word, out, file);
    }
}

class StoredFile final : public VolumeFile {
  public:
    StoredFile(std::filesystem::path header, SeriesInfo info, StoredLayout layout,
               ChosenScalar chosen)
        : header_(std::move(header)), info_(std::move(info)), layout_(std::move(layout)),
          chosen_(std::move(chosen)) {}

    const SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override { return layout_.steps; }

    void read(std::size_t step, std::span<std::byte> out) override {
        const std::string name = layout_.data.string();
        const std::size_t bytes = step_bytes();
        // Values that need no conversion go straight to where they belong.
        if (layout_.array.components == 1 &&
            stored_type_of(chosen_.value_type()) == *layout_.array.type &&
            chosen_.component != ChosenScalar::kMagnitude)
            return load(step, out);
        std::vector<std::byte> tuples(bytes);
        load(step, tuples);
        convert(chosen_, tuples, info_.grid, out, name);
    }

    std::size_t step_bytes() const {
        return info_.grid.vertex_count() * layout_.array.components * size_of(*layout_.array.type);
    }

  private:
    void load(std::size_t step, std::span<std::byte> out) {
        if (layout_.ascii)
            return load_ascii(step, out);
        if (!stream_)
            stream_ = open_data(layout_.data, layout_.offset, layout_.compression);
        stream_->read(layout_.skip + step * std::uint64_t{out.size()}, out);
        if (layout_.big_endian)
            swap_bytes(out, size_of(*layout_.array.type));
    }

    void load_ascii(std::size_t step, std::span<std::byte> out) {
        if (values_.empty())
            parse_ascii();
        std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(step * out.size()), out.size(),
                    out.begin());
    }

    void parse_ascii() {
        const std::string name = layout_.data.string();
        std::string text(file_bytes(layout_.data) - layout_.offset, '\0');
        open_data(layout_.data, layout_.offset, Compression::none)
            ->read(0, std::as_writable_bytes(std::span(text)));
        constexpr std::string_view kBetween = " \t\r\n,";
        const std::size_t size = size_of(*layout_.array.type);
        std::vector<std::byte> values(step_bytes() * layout_.steps);
        std::size_t at = 0;
        for (std::size_t i = 0; i < values.size(); i += size) {
            const std::size_t begin = text.find_first_not_of(kBetween, at);
            if (begin == std::string::npos)
                throw Error(fmt::format("{}: truncated: {} values, expected {}", name, i / size,
                                        values.size() / size));
            at = std::min(text.find_first_of(kBetween, begin), text.size());
            parse_number(*layout_.array.type, std::string_view(text).substr(begin, at - begin),
                         &values[i], name);
        }
        values_ = std::move(values);
    }

    std::filesystem::path header_;
    SeriesInfo info_;
    StoredLayout layout_;
    ChosenScalar chosen_;
    std::unique_ptr<DataStream> stream_;
    std::vector<std::byte> values_; ///< of all steps, ascii only
};

} // namespace

std::unique_ptr<VolumeFile> open_stored(const std::filesystem::path& header, SeriesInfo info,
                                        const StoredLayout& layout, const ReadOptions& options) {
    const std::string name = header.string();
    check_grid(info.grid, name);
    const ChosenScalar chosen = choose_scalar(std::span(&layout.array, 1), options, name);
    info.array = chosen.label();
    info.type = chosen.value_type();
    for (std::string& note : chosen.notes())
        info.notes.push_back(std::move(note));
    // A text value takes a digit and a blank; the last may go without its blank.
    const double values = static_cast<double>(info.grid.vertex_count()) * layout.array.components *
                          static_cast<double>(layout.steps);
    const double bytes = layout.ascii ? values * 2 - 1
                                      : values * static_cast<double>(size_of(*layout.array.type)) +
                                            static_cast<double>(layout.skip);
    constexpr double kMost = 1e18; // beyond any file, within 64 bits
    expect_room(layout.data, layout.offset, layout.compression,
                static_cast<std::uint64_t>(std::min(bytes, kMost)));
    // Only now is it known that there are as many steps as the header says.
    if (layout.steps > 1 && layout.time_step > 0 && std::isfinite(layout.time_step))
        for (std::size_t step = 0; step < layout.steps; ++step)
            info.times.push_back(layout.first_time + static_cast<double>(step) * layout.time_step);
    if (info.times.empty())
        info.time_unit.clear();
    return std::make_unique<StoredFile>(header, std::move(info), layout, chosen);
}

void set_axes(Grid& grid, const glm::dmat3& steps, const std::string& file) {
    for (int axis = 0; axis < 3; ++axis) {
        const double length = glm::length(steps[axis]);
        if (!(length > 0) || !std::isfinite(length))
            throw Error(fmt::format("{}: the spacing along axis {} is {}, expected a positive "
                                    "number",
                                    file, axis, length));
        grid.spacing[axis] = length;
        grid.direction[axis] = steps[axis] / length + 0.0; // no -0, which reads badly
    }
    if (std::abs(glm::determinant(grid.direction)) < 1e-6)
        throw Error(fmt::format("{}: the three axes lie in a plane", file));
}

void check_grid(const Grid& grid, const std::string& file) {
    checked_vertices({grid.vertices[0], grid.vertices[1], grid.vertices[2]}, file);
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(grid.origin[axis]))
            throw Error(fmt::format("{}: the origin is not finite", file));
}

std::array<std::uint32_t, 3> checked_vertices(const std::array<std::int64_t, 3>& sizes,
                                              const std::string& file) {
    const std::string got = fmt::format("{}x{}x{}", sizes[0], sizes[1], sizes[2]);
    if (std::any_of(sizes.begin(), sizes.end(), [](std::int64_t n) { return n < 2; }))
        throw Error(fmt::format("{}: {} vertices, needs at least 2 vertices per axis", file, got));
    std::uint64_t cells = 1;
    constexpr std::uint64_t kMost = 0xffff'fffe;
    for (std::int64_t n : sizes) {
        const std::uint64_t along = static_cast<std::uint64_t>(n - 1);
        if (along > kMost / cells)
            throw Error(fmt::format("{}: {} vertices make too many cells, at most {} are supported",
                                    file, got, kMost));
        cells *= along;
    }
    return {static_cast<std::uint32_t>(sizes[0]), static_cast<std::uint32_t>(sizes[1]),
            static_cast<std::uint32_t>(sizes[2])};
}

} // namespace isochron::index
