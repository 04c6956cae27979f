// Divides a picture into square tiles of a few pixels, with a number for each.
#pragma once

#include "render/gl/view.h"

#include <cstddef>
#include <span>
#include <vector>

namespace isochron::render {

/// The tiles as plain data, for SIMD code.
struct TileNumbers {
    static constexpr std::size_t kSlack = 16; ///< numbers behind the last tile that may be written
    float* numbers;                           ///< row by row
    int bits;                                 ///< tiles have 1 << bits pixels across and up
    int columns, rows;

    float* row(int number) const { return numbers + static_cast<std::size_t>(number) * columns; }
};

class PictureTiles {
  public:
    /// Chooses the tiles' size and fills all tiles with `number`. With smaller tiles more is found
    /// to be hidden; larger ones take less time.
    /// @param sizes of the occluders [pixel]; every 16th is sampled, zeros are skipped. If all are
    /// 0, tiles have 1 << most_bits pixels
    /// @param across number of tiles across an occluder of mean size: at least this, less than
    /// twice this, if tiles of 1 to 1 << most_bits pixels allow it
    void lay_out(const View& view, std::span<const float> sizes, float across, int most_bits,
                 float number);

    TileNumbers numbers() { return {numbers_.data(), bits_, columns_, rows_}; }

  private:
    std::vector<float> numbers_;
    int bits_ = 0, columns_ = 0, rows_ = 0;
};

} // namespace isochron::render
