// Fields of thin and of small things, at any size and at little cost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace isochron::bench {

constexpr std::uint64_t kSeedOfTurbulence = 12345, kSeedOfColors = 54321;

/// Makes the values of a step in a cube, [z][y][x], x fastest.
using MakeField = std::function<void(std::size_t step, std::span<float> values)>;

/// A network of tubes, of which those at 0.5 are some three voxels thick: 1 on the lines where two
/// sums of random waves are both 0, less around them. @param size vertices along each axis
MakeField tubes_of(std::size_t size);

/// Blobs that are 1 in their middles; at 0.5 they are one to three voxels large.
MakeField specks_of(std::size_t size);

} // namespace isochron::bench
