// A picture as square tiles of a few pixels, with a number for each.
#pragma once

#include "render/gl/view.h"

#include <cstddef>
#include <span>
#include <vector>

namespace isochron::render {

/// Tiles as code for one kind of processor goes through them.
struct TileNumbers {
    static constexpr std::size_t kSlack = 16; ///< numbers behind the last that are written, too
    float* numbers;                           ///< row by row
    int bits;                                 ///< tiles have 1 << bits pixels across and up
    int columns, rows;
};

class PictureTiles {
  public:
    /// Fills all tiles with a number. Smaller tiles find more that is hidden, larger ones take less
    /// time.
    /// @param sizes of what hides [pixel]; some of them are looked at, and none that are 0. Where
    /// there are no others, tiles are as large as may be
    /// @param across so many tiles, and less than twice as many, lie across the mean of the sizes,
    /// unless they had less than a pixel or more than 1 << most_bits
    void lay_out(const View& view, std::span<const float> sizes, float across, int most_bits,
                 float number);

    TileNumbers numbers() { return {numbers_.data(), bits_, columns_, rows_}; }

  private:
    std::vector<float> numbers_;
    int bits_ = 0, columns_ = 0, rows_ = 0;
};

} // namespace isochron::render
