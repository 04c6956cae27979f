// The extremes of cells, as keys.
#include "index/volume/cell_extremes.h"

#include <algorithm>

namespace isochron::index {

CellExtremes::CellExtremes(const StepValues& values)
    : values_(values), keys_(values.type, values.scaling),
      columns_low_(values.grid.vertices[0] * size_of(values.type)),
      columns_high_(columns_low_.size()), columns_nan_(values.grid.vertices[0]) {}

void CellExtremes::row(std::size_t step, std::uint32_t y, std::uint32_t z, std::span<OrderKey> low,
                       std::span<OrderKey> high) {
    const std::size_t nx = values_.grid.vertices[0];
    const std::size_t plane = nx * values_.grid.vertices[1];
    visit_value_type(values_.type, [&]<class T>(std::type_identity<T>) {
        const T* a = values_.step<T>(step).data() + z * plane + y * nx;
        const T* b = a + nx;
        const T* c = a + plane;
        const T* d = c + nx;
        T* column_low = reinterpret_cast<T*>(columns_low_.data());
        T* column_high = reinterpret_cast<T*>(columns_high_.data());
        std::uint8_t* nan = columns_nan_.data();
        for (std::size_t x = 0; x < nx; ++x) {
            column_low[x] = std::min(std::min(a[x], b[x]), std::min(c[x], d[x]));
            column_high[x] = std::max(std::max(a[x], b[x]), std::max(c[x], d[x]));
        }
        if constexpr (std::is_floating_point_v<T>)
            for (std::size_t x = 0; x < nx; ++x)
                nan[x] = (a[x] != a[x]) | (b[x] != b[x]) | (c[x] != c[x]) | (d[x] != d[x]);
        for (std::size_t x = 0; x + 1 < nx; ++x) {
            const T smallest = std::min(column_low[x], column_low[x + 1]);
            const T largest = std::max(column_high[x], column_high[x + 1]);
            const bool number = !(nan[x] | nan[x + 1]);
            const OrderKey low_key = keys_.low_key(keys_.reversed() ? largest : smallest);
            const OrderKey high_key = keys_.high_key(keys_.reversed() ? smallest : largest);
            low[x] = number ? low_key : 1;
            high[x] = number ? high_key : 0;
        }
    });
}

} // namespace isochron::index
