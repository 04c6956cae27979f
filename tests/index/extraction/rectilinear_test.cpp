// Rectilinear grids: normals, planes, meshes, picking and samples where vertices are uneven, each
// against its definition.
#include "index/extraction/cell_ray.h"
#include "index/extraction/value_in_index.h"
#include "index/indexing/index_build.h"
#include "index/scan/scan.h"
#include "index/surface/mesh_parts.h"
#include "index/volume/sample.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_field.h"
#include "tests/support/test_folder.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace isochron::index {
namespace {

/// A turned grid, with gaps from 0.1 to 10 along x and z.
Grid uneven_grid(std::mt19937& random, std::array<std::uint32_t, 3> vertices) {
    Grid grid{.vertices = vertices, .origin = {-40, 100, 3.5}, .spacing = {1, 0.7, 1}};
    grid.direction =
        glm::dmat3(glm::mat3_cast(glm::angleAxis(0.8, glm::normalize(glm::dvec3(1, 2, -0.5)))));
    for (const std::size_t axis : {0u, 2u}) {
        std::vector<double> at{0.0};
        while (at.size() < vertices[axis])
            at.push_back(at.back() +
                         std::pow(10, std::uniform_real_distribution(-1.0, 1.0)(random)));
        grid.spacing[static_cast<int>(axis)] = at.back() / (vertices[axis] - 1);
        grid.positions[axis] = AxisPositions(std::move(at));
    }
    return grid;
}

/// The place of a vertex, straight from the positions.
glm::dvec3 place_of(const Grid& grid, std::array<std::uint32_t, 3> vertex) {
    glm::dvec3 at = grid.origin;
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t i = vertex[static_cast<std::size_t>(axis)];
        const auto& distances = grid.positions[static_cast<std::size_t>(axis)].distances();
        at += grid.direction[axis] * (distances.empty() ? grid.spacing[axis] * i : distances[i]);
    }
    return at;
}

/// A field that says a function of physical places.
template <class Function>
TestField field_on(const Grid& grid, const Function& of_place, ValueType type = ValueType::f64) {
    return {grid.vertices, 1, type, [&](double x, double y, double z, double) {
                return of_place(
                    place_of(grid, {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                    static_cast<std::uint32_t>(z)}));
            }};
}
StepValues on(const TestField& field, const Grid& grid) {
    StepValues values = field.view();
    values.grid = grid;
    return values;
}

CellSet active(const StepValues& values, double isovalue) {
    CellSet set;
    set.query = {Instant(0), isovalue};
    scan(values, set.query, set.ids);
    EXPECT_TRUE(shade_cells(values, set));
    return set;
}

TEST(Rectilinear, PlacesAndIndicesLeadToEachOtherAndVerticesLieWhereTheFileHasThem) {
    std::mt19937 random(test_seed());
    const Grid grid = uneven_grid(random, {9, 7, 8});
    for (std::uint32_t i = 0; i < 7; ++i)
        EXPECT_LT(glm::distance(grid.physical({i, i, i}), place_of(grid, {i, i, i})), 1e-12);
    for (int i = 0; i < 500; ++i) {
        std::uniform_real_distribution uniform(-2.0, 10.0);
        const glm::dvec3 index(uniform(random), uniform(random), uniform(random));
        EXPECT_LT(glm::distance(grid.index_of(grid.physical(index)), index), 1e-9);
    }
}

TEST(Rectilinear, NormalsAndPlanesOfARampAreTheRampsOwnInEveryCell) {
    std::mt19937 random(test_seed());
    const Grid grid = uneven_grid(random, {12, 11, 10});
    const glm::dvec3 gradient(0.3, -1.2, 0.8);
    const auto ramp = [&](const glm::dvec3& p) { return glm::dot(gradient, p); };
    for (const ValueType type : {ValueType::f32, ValueType::f64}) {
        const TestField field = field_on(grid, ramp, type);
        const StepValues values = on(field, grid);
        const double isovalue = ramp(grid.physical({5.3, 4.9, 4.6}));
        const CellSet set = active(values, isovalue);
        ASSERT_GT(set.ids.size(), 50u);
        int near = 0;
        for (std::size_t i = 0; i < set.ids.size(); ++i) {
            const CellPlane packed = unpack_plane(set.points[i].plane);
            const CellPlane exact = cell_plane(values, set.query, set.ids[i]);
            EXPECT_LT(glm::distance(packed.normal, -glm::normalize(gradient)), 2e-3);
            EXPECT_LT(glm::distance(exact.normal, -glm::normalize(gradient)), 1e-4);
            EXPECT_NEAR(packed.offset, exact.offset, CellPlane::kFarthest / 127);
            // The plane's place is in voxels: along its normal there.
            const auto cell = grid.cell_of(set.ids[i]);
            const glm::dvec3 low = place_of(grid, cell);
            const glm::dvec3 size = place_of(grid, {cell[0] + 1, cell[1] + 1, cell[2] + 1}) - low;
            const glm::dvec3 sides = glm::transpose(grid.direction) * size;
            const glm::dvec3 along =
                glm::normalize(-(gradient * grid.direction) * sides); // index space
            if (std::abs(exact.offset) < 0.8) {
                const glm::dvec3 at = low + grid.direction * (sides * (0.5 + exact.offset * along));
                EXPECT_NEAR(ramp(at), isovalue, 1e-4);
                ++near;
            }
        }
        EXPECT_GT(near, 40);
    }
}

TEST(Rectilinear, MeshesLieOnTheSurfaceAndHaveTheNormalsOfAParaboloid) {
    std::mt19937 random(test_seed());
    const Grid grid = uneven_grid(random, {14, 15, 13});
    const glm::dvec3 center = grid.physical({6.5, 7, 6.5});
    const auto bowl = [&](const glm::dvec3& p) { return glm::dot(p - center, p - center); };
    const TestField field = field_on(grid, bowl);
    const StepValues values = on(field, grid);
    const double isovalue = bowl(grid.physical({6.5, 2.5, 6.5}));
    std::vector<CellId> ids;
    scan(values, {Instant(0), isovalue}, ids);
    std::vector<MeshMaker> makers(2);
    CellMesh mesh;
    ASSERT_TRUE(make_mesh(makers, values, {Instant(0), isovalue}, ids, mesh));
    int inner = 0;
    for (const MeshVertex& vertex : mesh.vertices) {
        const glm::dvec3 at = grid.physical(position_of(vertex));
        const auto value = value_at(values, 0, at);
        ASSERT_TRUE(value);
        EXPECT_NEAR(*value, isovalue, 1e-5 * isovalue);
        const std::array<std::uint32_t, 3> v{vertex.x, vertex.y, vertex.z};
        bool border = false;
        for (std::size_t axis = 0; axis < 3; ++axis)
            border |= v[axis] == 0 || v[axis] + 2 >= grid.vertices[axis];
        if (border)
            continue; // one-sided slopes there
        // Slopes of parabolas are exact, and linear along edges.
        EXPECT_LT(glm::distance(normal_of(vertex), -glm::normalize(at - center)), 1e-3);
        ++inner;
    }
    EXPECT_GT(inner, 100);
}

/// The first change of side along a ray, by many small steps through space.
std::optional<double> marched(const StepValues& values, const Ray& ray, double isovalue,
                              double reach) {
    constexpr int kSteps = 6000;
    const auto above = [&](double t) -> std::optional<bool> {
        const auto value = value_at(values, 0, ray.origin + t * ray.direction);
        return value ? std::optional(*value >= isovalue) : std::nullopt;
    };
    double before = 0;
    auto side = above(before);
    for (int i = 1; i <= kSteps; ++i) {
        const double t = reach * i / kSteps;
        const auto now = above(t);
        if (side && now && *now != *side) {
            double low = before, high = t;
            for (int halving = 0; halving < 50; ++halving) {
                const double middle = 0.5 * (low + high);
                (above(middle) == side ? low : high) = middle;
            }
            return high;
        }
        side = now;
        before = t;
    }
    return std::nullopt;
}

/// Values of vertices between which a place lies, found and weighted axis by axis.
double interpolated(const TestField::Function& function, const Grid& grid, const glm::dvec3& at) {
    const glm::dvec3 along = glm::transpose(grid.direction) * (at - grid.origin);
    std::array<std::uint32_t, 3> low{};
    glm::dvec3 share;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const auto distance = [&](std::uint32_t i) {
            const auto& at_axis = grid.positions[a].distances();
            return at_axis.empty() ? grid.spacing[axis] * i : at_axis[i];
        };
        while (low[a] + 2 < grid.vertices[a] && distance(low[a] + 1) <= along[axis])
            ++low[a];
        share[axis] = (along[axis] - distance(low[a])) / (distance(low[a] + 1) - distance(low[a]));
    }
    double sum = 0;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const std::uint32_t x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
        sum += function(low[0] + x, low[1] + y, low[2] + z, 0) * (x ? share.x : 1 - share.x) *
               (y ? share.y : 1 - share.y) * (z ? share.z : 1 - share.z);
    }
    return sum;
}

class RectilinearIndex : public testing::Test {
  protected:
    RectilinearIndex() {
        MemorySeries series(values_);
        build_index(series, path_, {});
        file_ = IndexFile::open(path_);
    }

    std::mt19937 random_{test_seed()};
    const Grid grid_ = uneven_grid(random_, {21, 18, 40});
    const TestField::Function function_ = turbulence(random_, 24);
    const TestField field_{grid_.vertices, 1, ValueType::f32, function_};
    const StepValues values_ = on(field_, grid_);
    const test_support::TestFolder folder_;
    const std::filesystem::path path_ = folder_.path() / "a.isochron";
    std::shared_ptr<const IndexFile> file_;
};

TEST_F(RectilinearIndex, SamplesAreInterpolatedBetweenTheVerticesAroundThem) {
    EXPECT_EQ(file_->info().grid, grid_);
    for (int i = 0; i < 300; ++i) {
        std::uniform_real_distribution share(0.0, 1.0);
        const glm::dvec3 last(20, 17, 39);
        const glm::dvec3 at =
            grid_.physical(last * glm::dvec3(share(random_), share(random_), share(random_)));
        const auto value = value_in(*file_, Instant(0), at);
        ASSERT_TRUE(value);
        EXPECT_NEAR(*value, interpolated(function_, grid_, at), 1e-5);
    }
    EXPECT_FALSE(value_in(*file_, Instant(0), grid_.physical({-0.01, 3, 3})));
    EXPECT_FALSE(value_in(*file_, Instant(0), grid_.physical({3, 3, 39.01})));
}

TEST_F(RectilinearIndex, PickingFindsWhatAMarchThroughSpaceFinds) {
    constexpr double kIsovalue = 0.1;
    const ExtractionPtr shown = extract_from(file_)({Instant(0), {kIsovalue}}, {});
    ASSERT_TRUE(shown);
    const glm::dvec3 last(20, 17, 39);
    const double size = glm::distance(grid_.physical({0, 0, 0}), grid_.physical(last));
    std::uniform_real_distribution share(0.0, 1.0);
    const auto place = [&] {
        return grid_.physical(last * glm::dvec3(share(random_), share(random_), share(random_)));
    };
    int hits = 0, different = 0;
    constexpr int kRays = 150;
    for (int i = 0; i < kRays; ++i) {
        const glm::dvec3 to = place();
        glm::dvec3 from = place();
        if (i % 2 == 0) // from outside
            from = to + 0.8 * size * glm::normalize(from - to);
        const Ray ray{from, glm::normalize(to - from)};
        const auto expected = marched(values_, ray, kIsovalue, 1.9 * size);
        const auto hit = first_hit(*shown, grid_, ray);
        if (hit.has_value() != expected.has_value() ||
            (hit && std::abs(hit->along - *expected) > 1e-4 * size)) {
            ++different;
            continue;
        }
        hits += hit.has_value();
        if (const auto entry = entry_into(grid_, ray)) {
            const glm::dvec3 index = grid_.index_of(*entry);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GT(index[axis], -1e-9);
                EXPECT_LT(index[axis], last[axis] + 1e-9);
            }
        }
    }
    EXPECT_LE(different, kRays / 30) << "a march misses two crossings between its steps";
    EXPECT_GT(hits, kRays / 3);
}

TEST_F(RectilinearIndex, LayersOfALargeStepAreShadedAsTheWholeIs) {
    const CellSet whole = active(values_, 0.1);
    for (const std::uint32_t first : {0u, 15u, 31u}) {
        const std::uint32_t end = std::min(first + 19, 40u);
        StepValues part = values_;
        part.grid = grid_.planes(first, end);
        part.first = values_.first + std::size_t{first} * 21 * 18 * sizeof(float);
        for (std::uint32_t z = first + 1; z + 2 < end; ++z) {
            const CellId plane = 20 * 17;
            for (const CellId id : whole.ids)
                if (id / plane == z) {
                    const CellPlane a = cell_plane(part, whole.query, id - first * plane);
                    const CellPlane b = cell_plane(values_, whole.query, id);
                    ASSERT_LT(glm::distance(a.normal, b.normal), 1e-12);
                    ASSERT_NEAR(a.offset, b.offset, 1e-12);
                }
        }
    }
}

} // namespace
} // namespace isochron::index
