// Squares as the vertex shader makes them, and tiles that they cover.
#include "render/seen_cells.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::render {

namespace {

/// [pixels] by which GL's squares may be larger or smaller than ours: it rounds to 1/256.
constexpr float kMargin = 1.0f / 16.0f;
/// Of clip depth: rounded otherwise on the way through GL, what is as good as level hides nothing.
constexpr float kLevel = 1e-6f;
constexpr float kTilesAcross = 3.0f; ///< of a square at least
constexpr int kMostTileBits = 4;

/// Rounded down, for less than a call of std::floor takes. @param at -4096 to 16384
int pixel_at(float at) {
    constexpr int kBelow = 4096;
    return static_cast<int>(at + static_cast<float>(kBelow)) - kBelow;
}

} // namespace

std::span<const std::uint32_t> SeenCells::find(const View& view, const Placement& placement,
                                               float radius, std::span<const CellPlace> places,
                                               std::span<const std::uint32_t> back_to_front) {
    project(view, placement, radius, places, back_to_front);
    choose_tiles(view);
    nearest_.assign(static_cast<std::size_t>(columns_) * rows_, std::numeric_limits<float>::max());
    seen_.clear();
    for (std::size_t i = 0; i < squares_.size(); ++i) {
        const Square& square = squares_[i];
        if (hidden(square, touched(square.x, square.half, columns_),
                   touched(square.y, square.half, rows_)))
            continue;
        seen_.push_back(back_to_front[squares_.size() - 1 - i]);
        const Tiles across = covered(square.x, square.half, columns_);
        const Tiles up = covered(square.y, square.half, rows_);
        for (int row = up.first; row <= up.last; ++row) {
            float* const tiles = &nearest_[static_cast<std::size_t>(row) * columns_];
            for (int column = across.first; column <= across.last; ++column)
                tiles[column] = std::min(tiles[column], square.z);
        }
    }
    return seen_;
}

/// As cell.vert does it.
void SeenCells::project(const View& view, const Placement& placement, float radius,
                        std::span<const CellPlace> places,
                        std::span<const std::uint32_t> back_to_front) {
    const glm::vec2 half_size = 0.5f * glm::vec2(view.size);
    const glm::mat4 rows =
        glm::transpose(view.clip_from_eye * view.eye_from_room * placement.room_from_index);
    const glm::vec4 row_x = half_size.x * rows[0], row_y = half_size.y * rows[1], row_z = rows[2],
                    row_w = rows[3];
    const float rr = radius * radius;
    const glm::vec3 w3(row_w);
    const float tilt2 = glm::dot(w3, w3);
    squares_.resize(back_to_front.size());
    for (std::size_t i = 0; i < squares_.size(); ++i) {
        const CellPlace& place = places[back_to_front[squares_.size() - 1 - i]];
        const glm::vec4 centre(place.x + 0.5f, place.y + 0.5f, place.z + 0.5f, 1.0f);
        const float w = glm::dot(row_w, centre), over_w = 1.0f / w;
        const float x = glm::dot(row_x, centre) * over_w, y = glm::dot(row_y, centre) * over_w;
        const glm::vec3 a = glm::vec3(row_x) - x * w3, b = glm::vec3(row_y) - y * w3;
        const float k = rr / (w * w - rr * tilt2);
        const float shift_x = -k * glm::dot(a, w3), shift_y = -k * glm::dot(b, w3);
        const float half2 = std::max(shift_x * shift_x + k * glm::dot(a, a),
                                     shift_y * shift_y + k * glm::dot(b, b));
        squares_[i] = {half_size.x + x + shift_x, half_size.y + y + shift_y,
                       glm::dot(row_z, centre) * over_w, std::sqrt(half2)};
    }
}

/// Smaller tiles find more cells hidden, larger ones take less time: a square covers some.
void SeenCells::choose_tiles(const View& view) {
    float smallest = std::numeric_limits<float>::max();
    for (const Square& square : squares_)
        smallest = std::min(smallest, square.half);
    tile_bits_ = 0;
    while (tile_bits_ < kMostTileBits &&
           static_cast<float>(1 << tile_bits_) * kTilesAcross <= smallest)
        ++tile_bits_;
    columns_ = ((view.size.x - 1) >> tile_bits_) + 1;
    rows_ = ((view.size.y - 1) >> tile_bits_) + 1;
}

/// Tiles of which the square may draw the middle of a pixel.
SeenCells::Tiles SeenCells::touched(float middle, float half, int count) const {
    return {std::max(pixel_at(middle - half - kMargin) >> tile_bits_, 0),
            std::min(pixel_at(middle + half + kMargin) >> tile_bits_, count - 1)};
}

/// Tiles of which the square surely draws the middles of all pixels.
SeenCells::Tiles SeenCells::covered(float middle, float half, int count) const {
    const int first = pixel_at(middle - half + kMargin - 0.5f) + 1;
    const int end = pixel_at(middle + half - kMargin + 0.5f);
    return {std::max((first + (1 << tile_bits_) - 1) >> tile_bits_, 0),
            std::min(end >> tile_bits_, count) - 1};
}

bool SeenCells::hidden(const Square& square, Tiles across, Tiles up) const {
    const float nearer = square.z - kLevel;
    for (int row = up.first; row <= up.last; ++row) {
        const float* const tiles = &nearest_[static_cast<std::size_t>(row) * columns_];
        for (int column = across.first; column <= across.last; ++column)
            if (!(tiles[column] < nearer))
                return false;
    }
    return true;
}

} // namespace isochron::render
