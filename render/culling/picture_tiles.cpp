// Chooses the size of tiles.
#include "render/culling/picture_tiles.h"

#include <limits>

namespace isochron::render {

void PictureTiles::lay_out(const View& view, std::span<const float> sizes, float across,
                           int most_bits, float number) {
    constexpr std::size_t kEvery = 16; // every 16th size is enough for their mean
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < sizes.size(); i += kEvery)
        if (sizes[i] > 0.0f) {
            sum += sizes[i];
            ++count;
        }
    const double mean = count > 0.0 ? sum / count : std::numeric_limits<double>::infinity();
    bits_ = 0;
    while (bits_ < most_bits && (2 << bits_) * static_cast<double>(across) <= mean)
        ++bits_;
    columns_ = ((view.size.x - 1) >> bits_) + 1;
    rows_ = ((view.size.y - 1) >> bits_) + 1;
    numbers_.assign(static_cast<std::size_t>(columns_) * rows_ + TileNumbers::kSlack, number);
}

} // namespace isochron::render
