// Ripples on the distance from a sphere, chunk by chunk.
#include "tests/bench/measures/changing_series.h"

#include "index/file/chunks/chunk_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

namespace isochron::bench {
namespace {

constexpr double kCellsOfArea = 1.5; ///< a sphere's cells over its area

/// Distance of a chunk's middle from the sphere.
double off_sphere(const std::array<std::uint32_t, 3>& chunk, std::uint32_t size, double radius) {
    double square = 0;
    for (const std::uint32_t along : chunk) {
        const double from_middle = (along + 0.5) * index::kChunkEdge - 0.5 * (size - 1);
        square += from_middle * from_middle;
    }
    return std::abs(std::sqrt(square) - radius);
}

/// In [-1, 1], of one vertex.
float roughness(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t version) {
    std::uint32_t h = x * 73856093u ^ y * 19349663u ^ z * 83492791u ^ version * 2654435761u;
    h ^= h >> 13;
    h *= 0x5bd1e995u;
    h ^= h >> 15;
    return static_cast<float>(h & 0xffff) / 32768.0f - 1.0f;
}

} // namespace

ChangingSeries::ChangingSeries(std::uint32_t size, double cells, std::vector<double> stay,
                               Changing changing)
    : size_(size), along_((size + index::kChunkEdge - 1) / index::kChunkEdge),
      radius_(std::sqrt(cells / kCellsOfArea / (4 * std::numbers::pi))) {
    info_.array = "distance";
    info_.grid.vertices = {size, size, size};
    info_.type = index::ValueType::f32;
    for (std::size_t t = 0; t <= stay.size(); ++t) {
        info_.times.push_back(static_cast<double>(t));
        info_.sources.push_back(fmt::format("step {}", t));
    }
    // The chunks near the sphere, along z or in any order; all others stay.
    std::vector<std::size_t> near;
    for (std::uint32_t z = 0; z < along_; ++z)
        for (std::uint32_t y = 0; y < along_; ++y)
            for (std::uint32_t x = 0; x < along_; ++x)
                if (off_sphere({x, y, z}, size, radius_) < index::kChunkEdge)
                    near.push_back((std::size_t{z} * along_ + y) * along_ + x);
    std::mt19937 random(1);
    versions_.emplace_back(std::size_t{along_} * along_ * along_);
    for (std::size_t t = 0; t < stay.size(); ++t) {
        if (changing == Changing::scattered)
            std::ranges::shuffle(near, random);
        auto& next = versions_.emplace_back(versions_.back());
        const auto others =
            static_cast<std::size_t>(std::lround((1 - stay[t]) * static_cast<double>(near.size())));
        for (std::size_t i = 0; i < others; ++i)
            next[near[i]] = static_cast<std::uint16_t>(t + 1);
    }
}

void ChangingSeries::read(std::size_t step, std::span<std::byte> out) {
    const double middle = 0.5 * (size_ - 1);
    std::vector<float> row(size_);
    for (std::uint32_t z = 0; z < size_; ++z)
        for (std::uint32_t y = 0; y < size_; ++y) {
            const double dz = z - middle, dy = y - middle;
            for (std::uint32_t x = 0; x < size_; ++x) {
                const double dx = x - middle;
                const std::uint32_t version =
                    versions_[step][(std::size_t{z / index::kChunkEdge} * along_ +
                                     y / index::kChunkEdge) *
                                        along_ +
                                    x / index::kChunkEdge];
                row[x] = static_cast<float>(radius_ - std::sqrt(dx * dx + dy * dy + dz * dz) +
                                            0.4 * std::sin(0.3 * x + version) *
                                                std::sin(0.25 * y + 0.7 * version)) +
                         0.05f * roughness(x, y, z, version);
            }
            std::memcpy(out.data() + (std::size_t{z} * size_ + y) * row.size() * sizeof(float),
                        row.data(), row.size() * sizeof(float));
        }
}

} // namespace isochron::bench
