// The stored value at which an isovalue divides the values of a type.
#include "index/volume/stored_cut.h"

#include "index/volume/ordinal.h"

#include <cmath>

namespace isochron::index {

std::optional<std::uint64_t> stored_cut(ValueType type, const Scaling& scaling, double isovalue) {
    if (!std::isfinite(isovalue))
        return std::nullopt;
    return visit_value_type(
        type, [&]<class T>(std::type_identity<T>) -> std::optional<std::uint64_t> {
            const std::uint64_t end = std::uint64_t{highest_ordinal<T>()} + 1;
            const std::uint64_t first =
                first_that(lowest_ordinal<T>(), end, [&](std::uint64_t number) {
                    const auto stored =
                        static_cast<double>(from_ordinal<T>(static_cast<Ordinal<T>>(number)));
                    return (scaling(stored) >= isovalue) == (scaling.slope > 0);
                });
            if (first == end)
                return std::nullopt;
            return first;
        });
}

} // namespace isochron::index
