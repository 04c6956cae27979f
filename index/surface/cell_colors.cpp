// Computes values of a second array on the isosurface.
#include "index/surface/cell_colors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isochron::index {
namespace {

constexpr std::size_t kCellsPerLook = 1 << 14; ///< cells between two looks at the stop token

/// The ends of a cell's twelve edges, as vertex numbers with x in bit 0, y in bit 1, z in bit 2.
constexpr std::array<std::array<int, 2>, 12> kEdges{{{0, 1},
                                                     {2, 3},
                                                     {4, 5},
                                                     {6, 7},
                                                     {0, 2},
                                                     {1, 3},
                                                     {4, 6},
                                                     {5, 7},
                                                     {0, 4},
                                                     {1, 5},
                                                     {2, 6},
                                                     {3, 7}}};

using CornerValues = std::array<double, 8>;

double mean_on_surface(const CornerValues& values, const CornerValues& colors, double isovalue) {
    double sum = 0.0;
    int cuts = 0;
    for (const auto& [a, b] : kEdges) {
        const bool above = values[a] >= isovalue;
        if (above == (values[b] >= isovalue))
            continue;
        // Halves keep the difference finite for any two doubles.
        const double along = (isovalue / 2 - values[a] / 2) / (values[b] / 2 - values[a] / 2);
        sum += (1 - along) * colors[a] + along * colors[b];
        ++cuts;
    }
    return sum / cuts; // NaN without a cut
}

/// Scaled values of the step at a cell's vertices.
class CornerReader {
  public:
    CornerReader(const StepValues& values, std::uint32_t step)
        : values_(values), bytes_(values.step_bytes(step)) {
        const std::uint64_t nx = values.grid.vertices[0], ny = values.grid.vertices[1];
        for (std::size_t k = 0; k < offsets_.size(); ++k)
            offsets_[k] = (k & 1) + nx * ((k >> 1 & 1) + ny * (k >> 2));
    }

    CornerValues at(CellId cell) const {
        const auto [x, y, z] = values_.grid.cell_of(cell);
        const std::uint64_t nx = values_.grid.vertices[0], ny = values_.grid.vertices[1];
        const std::uint64_t first = x + nx * (y + ny * z);
        CornerValues corners;
        visit_value_type(values_.type, [&]<class T>(std::type_identity<T>) {
            const T* stored = reinterpret_cast<const T*>(bytes_.data()) + first;
            for (std::size_t k = 0; k < corners.size(); ++k)
                corners[k] = values_.scaling(static_cast<double>(stored[offsets_[k]]));
        });
        return corners;
    }

  private:
    const StepValues& values_;
    std::span<const std::byte> bytes_;
    std::array<std::uint64_t, 8> offsets_{};
};

/// 0 to 1; 0 where the range is empty.
double share_of_range(double value, double low, double high) {
    const double half = high / 2 - low / 2; // halves keep the difference finite
    return half > 0 ? std::clamp((value / 2 - low / 2) / half, 0.0, 1.0) : 0.0;
}

} // namespace

std::uint16_t color_coordinate(double value, double low, double high) {
    if (std::isnan(value))
        return kNoColor;
    return static_cast<std::uint16_t>(std::lround(share_of_range(value, low, high) * kColorSteps));
}

std::uint16_t fine_color_coordinate(double value, double low, double high) {
    if (!std::isfinite(value))
        return kNoFineColor;
    return static_cast<std::uint16_t>(
        std::lround(share_of_range(value, low, high) * kFineColorSteps));
}

bool color_cells(const StepValues& volume, const StepValues& colors, const Query& query,
                 std::span<const CellId> cells, double low, double high,
                 std::span<std::uint16_t> out, const std::stop_token& stop) {
    const CornerReader values(volume, query.instant.step), color_values(colors, query.instant.step);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i % kCellsPerLook == 0 && stop.stop_requested())
            return false;
        const double mean =
            mean_on_surface(values.at(cells[i]), color_values.at(cells[i]), query.isovalue);
        out[i] = std::isfinite(mean) ? color_coordinate(mean, low, high) : kNoColor;
    }
    return true;
}

void color_corners(const StepValues& colors, Instant at, std::span<const CellId> cells, double low,
                   double high, std::span<std::uint16_t> out) {
    const CornerReader values(colors, at.step);
    for (std::size_t i = 0; i < cells.size(); ++i)
        std::ranges::transform(values.at(cells[i]), &out[8 * i], [&](double value) {
            return fine_color_coordinate(value, low, high);
        });
}

std::vector<float> values_at(const StepValues& colors, Instant at,
                             std::span<const MeshVertex> vertices, std::uint32_t first_plane) {
    const auto& n = colors.grid.vertices;
    const std::array<std::size_t, 3> next{1, n[0], std::size_t{n[0]} * n[1]};
    std::vector<float> values;
    values.reserve(vertices.size());
    visit_value_type(colors.type, [&]<class T>(std::type_identity<T>) {
        const std::span<const T> stored = colors.step<T>(at.step);
        for (const MeshVertex& vertex : vertices) {
            const std::size_t lower =
                vertex.x + next[1] * vertex.y + next[2] * std::size_t{vertex.z - first_plane};
            const double a = colors.scaling(static_cast<double>(stored[lower]));
            const double b = colors.scaling(static_cast<double>(stored[lower + next[vertex.axis]]));
            const double share = static_cast<double>(vertex.share) / MeshVertex::kWhole;
            values.push_back(static_cast<float>((1 - share) * a + share * b));
        }
    });
    return values;
}

} // namespace isochron::index
