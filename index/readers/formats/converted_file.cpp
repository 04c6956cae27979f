// Converts values between types.
#include "index/readers/formats/converted_file.h"

#include "index/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace isochron::index {
namespace {

bool is_float(ValueType type) {
    return type == ValueType::f32 || type == ValueType::f64;
}

/// Whether values of one type, scaled, may have more digits than another has.
bool may_round(const SeriesInfo& from, ValueType to) {
    return visit_value_type(from.type, [&]<class From>(std::type_identity<From>) {
        return visit_value_type(to, [&]<class To>(std::type_identity<To>) {
            return from.scaling != Scaling{} ||
                   std::numeric_limits<From>::digits > std::numeric_limits<To>::digits;
        });
    });
}

template <class From, class To>
To converted_value(From value, const Scaling& scaling, const std::string& file) {
    if constexpr (std::is_floating_point_v<To>) {
        return scaling == Scaling{} ? static_cast<To>(value)
                                    : static_cast<To>(scaling(static_cast<double>(value)));
    } else {
        const auto wide = static_cast<double>(value); // every type of a volume has exact doubles
        if (!(wide >= static_cast<double>(std::numeric_limits<To>::lowest()) &&
              wide <= static_cast<double>(std::numeric_limits<To>::max())) ||
            wide != std::floor(wide))
            throw Error("{}: holds {}, which no {} is: --type f32 or f64 keeps it", file, wide,
                        sizeof(To) == 1   ? "integer of 8 bits"
                        : sizeof(To) == 2 ? "integer of 16 bits"
                                          : "integer of 32 bits");
        return static_cast<To>(wide);
    }
}

class ConvertedFile final : public VolumeFile {
  public:
    ConvertedFile(std::unique_ptr<VolumeFile> file, ValueType type, std::string name)
        : file_(std::move(file)), name_(std::move(name)), info_(file_->info()) {
        info_.type = type;
        if (!is_float(type))
            return;
        info_.scaling = {};
        if (may_round(file_->info(), type))
            info_.notes.push_back(
                fmt::format("values of {}{} are rounded to {}", name_of(file_->info().type),
                            file_->info().scaling == Scaling{} ? "" : ", scaled,", name_of(type)));
    }

    const SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override { return file_->steps(); }
    std::vector<std::filesystem::path> beside() const override { return file_->beside(); }

    void read(std::size_t step, std::span<std::byte> out) override {
        std::size_t at = 0;
        file_->stream(step, [&](std::span<const std::byte> piece) {
            at += convert_to(piece, out.subspan(at));
        });
    }

    void stream(std::size_t step, const TakePiece& take) override {
        std::vector<std::byte> values;
        file_->stream(step, [&](std::span<const std::byte> piece) {
            values.resize(piece.size() / size_of(file_->info().type) * size_of(info_.type));
            take(std::span(values).first(convert_to(piece, values)));
        });
    }

  private:
    /// @return bytes written
    std::size_t convert_to(std::span<const std::byte> piece, std::span<std::byte> out) const {
        return visit_value_type(file_->info().type, [&]<class From>(std::type_identity<From>) {
            return visit_value_type(info_.type, [&]<class To>(std::type_identity<To>) {
                const auto* from = reinterpret_cast<const From*>(piece.data());
                auto* to = reinterpret_cast<To*>(out.data());
                const std::size_t count = piece.size() / sizeof(From);
                for (std::size_t i = 0; i < count; ++i)
                    to[i] = converted_value<From, To>(from[i], file_->info().scaling, name_);
                return count * sizeof(To);
            });
        });
    }

    std::unique_ptr<VolumeFile> file_;
    std::string name_;
    SeriesInfo info_;
};

} // namespace

std::unique_ptr<VolumeFile> converted(std::unique_ptr<VolumeFile> file, ValueType type,
                                      const std::filesystem::path& path) {
    if (file->info().type == type && (!is_float(type) || file->info().scaling == Scaling{}))
        return file;
    return std::make_unique<ConvertedFile>(std::move(file), type, path.string());
}

} // namespace isochron::index
