// Quads as the vertex shader makes them, and tiles that they cover.
#include "render/seen_cells.h"

#include "render/point_sprites.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::render {

namespace {

/// [pixels] by which GL's quads may be larger or smaller than ours: it rounds to 1/256.
constexpr float kMargin = 1.0f / 16.0f;
/// Of clip depth: rounded otherwise on the way through GL, what is as good as level hides nothing.
constexpr float kLevel = 1e-6f;
constexpr float kClipped =
    1.0f - kLevel;                   ///< what may be cut off by the frustum's ends hides nothing
constexpr double kTilesAcross = 3.0; ///< of a quad, about
constexpr int kMostTileBits = 4;
/// As in cell.vert: the quad of an ellipse is upright up to this (a^2 - b^2) / (a^2 + b^2) of its
/// half axes.
constexpr float kRound = 0.1f;

constexpr float kFar = 1e9f; ///< beyond any view and before any depth

/// Rounded down, for less than a call of std::floor takes; far beyond any view somewhere there.
int pixel_at(float at) {
    constexpr float kBelow = 4096.0f, kAbove = 65536.0f;
    return static_cast<int>(std::clamp(at, -kBelow, kAbove) + kBelow) - static_cast<int>(kBelow);
}

} // namespace

std::span<const std::uint32_t> SeenCells::find(const View& view, const Placement& placement,
                                               float radius, std::span<const CellPlace> places,
                                               std::span<const std::uint32_t> back_to_front) {
    project(view, placement, radius, places, back_to_front);
    choose_tiles(view);
    nearest_.assign(static_cast<std::size_t>(columns_) * rows_, std::numeric_limits<float>::max());
    seen_.clear();
    for (std::size_t i = 0; i < quads_.size(); ++i) {
        const Quad& quad = quads_[i];
        if (hidden(quad, touched(quad.x, quad.outer, columns_), touched(quad.y, quad.outer, rows_)))
            continue;
        seen_.push_back(back_to_front[quads_.size() - 1 - i]);
        const Tiles across = covered(quad.x, quad.inner, columns_);
        const Tiles up = covered(quad.y, quad.inner, rows_);
        for (int row = up.first; row <= up.last; ++row) {
            float* const tiles = &nearest_[static_cast<std::size_t>(row) * columns_];
            for (int column = across.first; column <= across.last; ++column)
                tiles[column] = std::min(tiles[column], quad.z);
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
    quads_.resize(back_to_front.size());
    for (std::size_t i = 0; i < quads_.size(); ++i) {
        const CellPlace& place = places[back_to_front[quads_.size() - 1 - i]];
        const glm::vec4 centre(place.x + 0.5f, place.y + 0.5f, place.z + 0.5f, 1.0f);
        const float w = glm::dot(row_w, centre), d = w * w - rr * tilt2;
        if (!(w > 0.0f && d > kLeastDepth * w * w)) {
            const bool behind = w < -1.01f * radius * std::sqrt(tilt2);
            quads_[i] = {kFar, kFar, -kFar, 0.0f, behind ? 0.0f : 2.0f * kFar};
            continue;
        }
        const float z = glm::dot(row_z, centre) / w;
        const float x = glm::dot(row_x, centre) / w, y = glm::dot(row_y, centre) / w;
        const glm::vec3 a = glm::vec3(row_x) - x * w3, b = glm::vec3(row_y) - y * w3;
        const float k = rr / d;
        const float shift_x = -k * glm::dot(a, w3), shift_y = -k * glm::dot(b, w3);
        const float xx = shift_x * shift_x + k * glm::dot(a, a);
        const float xy = shift_x * shift_y + k * glm::dot(a, b);
        const float yy = shift_y * shift_y + k * glm::dot(b, b);
        // Of a nearly round ellipse the quad is the image of a square under the symmetric root of
        // its shape, (s + sqrt(det s)) / sqrt(trace s + 2 sqrt(det s)).
        const float det = std::sqrt(std::max(xx * yy - xy * xy, 0.0f)), trace = xx + yy;
        const float over_root = 1.0f / std::sqrt(trace + 2.0f * det);
        const float most = (std::max(xx, yy) + det + std::abs(xy)) * over_root;
        const float uneven =
            std::sqrt((xx - yy) * (xx - yy) + 4.0f * xy * xy); // times the mean: of its half axes
        const bool round = uneven < kRound * trace;
        quads_[i] = {half_size.x + x + shift_x, half_size.y + y + shift_y, z,
                     round && std::abs(z) < kClipped ? det / most : 0.0f,
                     round ? most : std::sqrt(trace + uneven)};
    }
}

/// Smaller tiles find more cells hidden, larger ones take less time: most quads cover some.
void SeenCells::choose_tiles(const View& view) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const Quad& quad : quads_)
        if (quad.inner > 0.0f) {
            sum += quad.inner;
            ++count;
        }
    const double mean = sum / static_cast<double>(std::max(count, std::size_t{1}));
    tile_bits_ = 0;
    while (tile_bits_ < kMostTileBits && (1 << tile_bits_) * kTilesAcross <= mean)
        ++tile_bits_;
    columns_ = ((view.size.x - 1) >> tile_bits_) + 1;
    rows_ = ((view.size.y - 1) >> tile_bits_) + 1;
}

/// Tiles of which the quad may draw the middle of a pixel.
SeenCells::Tiles SeenCells::touched(float middle, float half, int count) const {
    return {std::max(pixel_at(middle - half - kMargin) >> tile_bits_, 0),
            std::min(pixel_at(middle + half + kMargin) >> tile_bits_, count - 1)};
}

/// Tiles of which the quad surely draws the middles of all pixels.
SeenCells::Tiles SeenCells::covered(float middle, float half, int count) const {
    const int first = pixel_at(middle - half + kMargin - 0.5f) + 1;
    const int end = pixel_at(middle + half - kMargin + 0.5f);
    return {std::max((first + (1 << tile_bits_) - 1) >> tile_bits_, 0),
            std::min(end >> tile_bits_, count) - 1};
}

bool SeenCells::hidden(const Quad& quad, Tiles across, Tiles up) const {
    const float nearer = quad.z - kLevel;
    for (int row = up.first; row <= up.last; ++row) {
        const float* const tiles = &nearest_[static_cast<std::size_t>(row) * columns_];
        for (int column = across.first; column <= across.last; ++column)
            if (!(tiles[column] < nearer))
                return false;
    }
    return true;
}

} // namespace isochron::render
