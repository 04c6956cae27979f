// The arrays among which files leave the choice.
#include "app/indexing/array_offers.h"

#include "app/safe_text.h"
#include "app/text.h"
#include "index/error.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

namespace isochron::app {
namespace {

struct WaitIsOver {};

/// What arrays that are shown together have in common.
struct Shape {
    index::Grid grid;
    std::vector<double> times;
    bool operator==(const Shape&) const = default;
};

/// Widens a range by stored values.
template <class T>
void widen(std::span<const std::byte> stored, double& low, double& high) {
    for (std::size_t at = 0; at + sizeof(T) <= stored.size(); at += sizeof(T)) {
        T value;
        std::memcpy(&value, &stored[at], sizeof value);
        const auto number = static_cast<double>(value);
        if (!std::isfinite(number))
            continue;
        low = std::min(low, number);
        high = std::max(high, number);
    }
}

} // namespace

std::vector<ArrayOffer> offered_arrays(const std::vector<std::filesystem::path>& files,
                                       const BuildArguments& arguments) {
    std::vector<ArrayOffer> offers;
    std::vector<Shape> shapes;
    for (const std::string& name : arrays_to_choose(files, arguments)) {
        ArrayOffer& offer = offers.emplace_back(ArrayOffer{.name = name, .shape = {}, .unit = {}});
        try {
            const ArraySource source = open_array(files, arguments, name);
            const index::SeriesInfo& info = source.series->info();
            offer.shape = grid_words(info);
            offer.unit = info.value_unit;
            const Shape shape{info.grid, info.times};
            const auto same = std::ranges::find(shapes, shape);
            offer.group = static_cast<std::size_t>(same - shapes.begin());
            if (same == shapes.end())
                shapes.push_back(shape);
        } catch (const index::Error& error) {
            offer.fault = one_line(error.what());
        }
    }
    return shapes.size() > 1 ? offers : std::vector<ArrayOffer>();
}

std::optional<std::array<double, 2>> first_range(const std::vector<std::filesystem::path>& files,
                                                 const BuildArguments& arguments,
                                                 const std::string& array,
                                                 const std::function<bool()>& goes_on) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    try {
        const ArraySource source = open_array(files, arguments, array);
        const index::SeriesInfo& info = source.series->info();
        source.series->stream(0, [&](std::span<const std::byte> piece) {
            if (!goes_on())
                throw WaitIsOver();
            index::visit_value_type(info.type, [&](auto type) {
                widen<typename decltype(type)::type>(piece, low, high);
            });
        });
        if (low > high)
            return std::nullopt;
        const double a = info.scaling(low), b = info.scaling(high);
        return std::array{std::min(a, b), std::max(a, b)};
    } catch (const WaitIsOver&) {
        return std::nullopt;
    } catch (const index::Error&) { // choosing the array would say what is wrong
        return std::nullopt;
    }
}

BuildSources open_chosen(const std::vector<std::filesystem::path>& files, BuildArguments& arguments,
                         const ChooseArray& choose) {
    if (!choose)
        return open_one_or_all(files, arguments);
    try {
        return open_sources(files, arguments);
    } catch (const index::Error&) {
        if (arrays_to_choose(files, arguments).empty())
            throw;
    }
    if (const auto offers = offered_arrays(files, arguments); !offers.empty())
        arguments = with_array(std::move(arguments), offers, choose(offers));
    else
        arguments.all_arrays = true;
    return open_sources(files, arguments);
}

BuildArguments with_array(BuildArguments arguments, const std::vector<ArrayOffer>& offers,
                          std::size_t chosen) {
    const ArrayOffer& first = offers.at(chosen);
    arguments.arrays = {first.name};
    arguments.read.array = first.name;
    for (const ArrayOffer& offer : offers)
        if (&offer != &first && offer.fault.empty() && offer.group == first.group &&
            !arguments.read.component)
            arguments.arrays.push_back(offer.name);
    return arguments;
}

} // namespace isochron::app
