// Measures of surfaces: identities, known shapes, and slow ways to the same numbers.
#include "index/measure/measures.h"

#include "index/measure/mesh_pieces.h"
#include "index/measure/vertex_sides.h"
#include "index/search/index_search.h"
#include "tests/support/indexed.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <set>

namespace isochron::index {
namespace {

using Vertices = std::array<std::uint32_t, 3>;

double value_of(const MeasuredSurface& found, std::string_view name) {
    for (std::size_t i = 0; i < measures().size(); ++i)
        if (measures()[i].name == name)
            return found.values[i];
    ADD_FAILURE() << name;
    return kNaN;
}

/// A turned, sheared and mirrored grid; stretched along y if wished.
Grid placed(const Vertices& vertices, bool stretched, std::mt19937& random) {
    Grid grid{.vertices = vertices, .origin = {1e4, -3, 20}, .spacing = {0.5, 2.0, 0.75}};
    const double angle = 0.1 + std::generate_canonical<double, 32>(random);
    grid.direction = glm::dmat3(glm::dvec3(std::cos(angle), std::sin(angle), 0),
                                glm::dvec3(std::sin(angle), -std::cos(angle), 0),
                                glm::normalize(glm::dvec3(0.3, 0, 1)));
    if (stretched) {
        std::vector<double> distances{0.0};
        for (std::uint32_t i = 1; i < vertices[1]; ++i)
            distances.push_back(distances.back() + 0.2 +
                                std::generate_canonical<double, 32>(random));
        grid.spacing.y = distances.back() / (vertices[1] - 1);
        grid.positions[1] = AxisPositions(distances);
    }
    return grid;
}

/// What is measured, cell by cell and vertex by vertex from the values alone.
class SlowMeasures {
  public:
    SlowMeasures(const StepValues& values, const Grid& grid, std::size_t step, double isovalue)
        : n_(grid.vertices), sides_(std::size_t{n_[0]} * n_[1] * n_[2]) {
        for (std::size_t i = 0; i < sides_.size(); ++i) {
            const double value = scaled_value(values, step, i);
            sides_[i] = std::isnan(value) ? 0 : value >= isovalue ? 1 : 2;
        }
        for (std::uint32_t z = 0; z + 1 < n_[2]; ++z)
            for (std::uint32_t y = 0; y + 1 < n_[1]; ++y)
                for (std::uint32_t x = 0; x + 1 < n_[0]; ++x)
                    add_cell(grid, x, y, z);
    }

    int side(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return sides_[at(x, y, z)];
    }

    /// Bodies by a flood from each vertex.
    std::uint64_t bodies() const {
        std::vector<bool> seen(sides_.size());
        std::uint64_t count = 0;
        for (std::size_t start = 0; start < sides_.size(); ++start) {
            if (sides_[start] != 1 || seen[start])
                continue;
            ++count;
            std::deque<std::size_t> next{start};
            seen[start] = true;
            while (!next.empty()) {
                const std::size_t i = next.front();
                next.pop_front();
                const Vertices place{static_cast<std::uint32_t>(i % n_[0]),
                                     static_cast<std::uint32_t>(i / n_[0] % n_[1]),
                                     static_cast<std::uint32_t>(i / n_[0] / n_[1])};
                for (std::size_t axis = 0; axis < 3; ++axis)
                    for (const int way : {-1, 1}) {
                        Vertices to = place;
                        to[axis] += static_cast<std::uint32_t>(way);
                        if (to[axis] >= n_[axis])
                            continue;
                        const std::size_t k = at(to[0], to[1], to[2]);
                        if (sides_[k] == 1 && !seen[k]) {
                            seen[k] = true;
                            next.push_back(k);
                        }
                    }
            }
        }
        return count;
    }

    double whole = 0;     ///< volume of all cells without a missing vertex
    double certain = 0;   ///< volume of the cells all of whose vertices are above
    double uncertain = 0; ///< volume of the active ones

  private:
    std::size_t at(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return x + std::size_t{n_[0]} * (y + std::size_t{n_[1]} * z);
    }
    void add_cell(const Grid& grid, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        int above = 0, missing = 0;
        for (std::uint32_t corner = 0; corner < 8; ++corner) {
            const int of = side(x + corner % 2, y + corner / 2 % 2, z + corner / 4);
            above += of == 1;
            missing += of == 0;
        }
        if (missing > 0)
            return;
        const auto to = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
            return grid.physical({x + i, y + j, z + k}) - grid.physical({x, y, z});
        };
        const double volume = std::abs(glm::dot(to(1, 0, 0), glm::cross(to(0, 1, 0), to(0, 0, 1))));
        whole += volume;
        if (above == 8)
            certain += volume;
        else if (above > 0)
            uncertain += volume;
    }

    Vertices n_;
    std::vector<int> sides_;
};

/// Area and pieces of a mesh, edge by edge in maps.
struct SlowMesh {
    double area = 0;
    std::size_t pieces = 0, edges = 0, border = 0;

    explicit SlowMesh(const SurfaceMesh& mesh) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> of_edge;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const auto& t = mesh.triangles[i];
            const auto point = [&](std::uint32_t k) {
                return glm::dvec3(mesh.points[k][0], mesh.points[k][1], mesh.points[k][2]);
            };
            area +=
                glm::length(glm::cross(point(t[1]) - point(t[0]), point(t[2]) - point(t[0]))) / 2;
            for (std::size_t k = 0; k < 3; ++k)
                of_edge[std::minmax(t[k], t[(k + 1) % 3])].push_back(i);
        }
        edges = of_edge.size();
        std::vector<std::set<std::size_t>> next(mesh.triangles.size());
        for (const auto& [edge, triangles] : of_edge) {
            border += triangles.size() == 1;
            for (const std::size_t a : triangles)
                for (const std::size_t b : triangles)
                    next[a].insert(b);
        }
        std::vector<bool> seen(mesh.triangles.size());
        for (std::size_t i = 0; i < seen.size(); ++i) {
            if (seen[i])
                continue;
            ++pieces;
            std::vector<std::size_t> open{i};
            while (!open.empty()) {
                const std::size_t now = open.back();
                open.pop_back();
                if (!seen[now]) {
                    seen[now] = true;
                    open.insert(open.end(), next[now].begin(), next[now].end());
                }
            }
        }
    }
};

class MeasuresTest : public testing::Test {
  protected:
    std::shared_ptr<const IndexFile> indexed_at(const StepValues& values, const Grid& grid,
                                                std::uint64_t cache = 0) {
        MemorySeries series(values);
        series.info().grid = grid;
        build_index(series, folder_.path() / "a.isochron", {});
        return IndexFile::open(folder_.path() / "a.isochron", cache);
    }
    MeasuredSurface measured(const TestField& field, const Query& query,
                             const MeasureWishes& wishes = {}) {
        return *SurfaceMeasures(indexed(folder_, field.view())).measure(query, wishes);
    }
    static double middle(const StepValues& values) {
        return quantiles(sorted_values(values), 3)[1];
    }

    test_support::TestFolder folder_;
    std::mt19937 random_{test_seed()};
};

TEST_F(MeasuresTest, AgreeWithSlowWaysOnEveryTypeGridAndTie) {
    for (const ValueType type : kAllTypes)
        for (const bool rough : {false, true}) {
            const Vertices n = rough ? Vertices{7, 5, 2} : Vertices{19, 17, 23};
            const TestField field(
                n, 2, type,
                scaled(rough ? white_noise(random_) : turbulence(random_), rough ? 3 : 100, 10),
                {random_() % 2 ? -0.5 : 2.0, 1.0});
            const Grid grid = placed(n, random_() % 2 != 0, random_);
            const auto file = indexed_at(field.view(), grid);
            SurfaceMeasures measuring(file);
            for (const double isovalue : ties(field.view(), 6)) {
                const MeasuredSurface found = *measuring.measure({Instant(1), isovalue});
                const SlowMeasures slow(field.view(), grid, 1, isovalue);
                const SurfaceMesh mesh = mesh_of(file, {Instant(1), isovalue});
                const SlowMesh of_mesh(mesh);
                const double volume = value_of(found, "volume");
                const double below = value_of(found, "volume-below");
                EXPECT_NEAR(volume + below, slow.whole, 1e-9 * slow.whole);
                EXPECT_GE(volume, slow.certain - 1e-9 * slow.whole);
                EXPECT_LE(volume, slow.certain + slow.uncertain + 1e-9 * slow.whole);
                EXPECT_EQ(value_of(found, "bodies"), static_cast<double>(slow.bodies()));
                EXPECT_EQ(value_of(found, "pieces"), static_cast<double>(of_mesh.pieces));
                EXPECT_EQ(value_of(found, "border-edges"), static_cast<double>(of_mesh.border));
                EXPECT_EQ(value_of(found, "euler"), static_cast<double>(mesh.points.size()) -
                                                        static_cast<double>(of_mesh.edges) +
                                                        static_cast<double>(mesh.triangles.size()));
                // Points of the mesh are floats, and far from 0.
                EXPECT_NEAR(value_of(found, "area"), of_mesh.area, 1e-2 * (1 + of_mesh.area));
            }
        }
}

TEST_F(MeasuresTest, AgreeWithSlowWaysWhereValuesAreMissing) {
    for (int round = 0; round < 8; ++round) {
        const Vertices n{13, 11, 9};
        TestField field(n, 1, ValueType::f32, scaled(white_noise(random_), 1, 0));
        for (std::size_t i = 0; i < 13 * 11 * 9; ++i)
            if (random_() % 12 == 0)
                field.at<float>(0, i) = static_cast<float>(random_() % 3 ? kNaN : kInfinity);
        const Grid grid = placed(n, true, random_);
        const auto file = indexed_at(field.view(), grid);
        const double isovalue = 0.1;
        const MeasuredSurface found = *SurfaceMeasures(file).measure({Instant(0), isovalue});
        const SlowMeasures slow(field.view(), grid, 0, isovalue);
        const SlowMesh of_mesh(mesh_of(file, {Instant(0), isovalue}));
        EXPECT_NEAR(value_of(found, "volume") + value_of(found, "volume-below"), slow.whole,
                    1e-9 * slow.whole);
        EXPECT_EQ(value_of(found, "bodies"), static_cast<double>(slow.bodies()));
        EXPECT_EQ(value_of(found, "pieces"), static_cast<double>(of_mesh.pieces));
        EXPECT_EQ(value_of(found, "border-edges"), static_cast<double>(of_mesh.border));
    }
}

TEST_F(MeasuresTest, OfAPlaneThroughABoxAreExact) {
    // x + 2 y + 3 z is linear: triangles lie in the plane, and the volume is a polynomial.
    const TestField field({6, 6, 6}, 1, ValueType::f64,
                          [](double x, double y, double z, double) { return x + 2 * y + 3 * z; });
    for (const double isovalue : {2.5, 4.0, 15.0, 23.7}) {
        const auto corner = [&](double less) {
            return less > 0 ? less * less * less / 36
                            : 0.0; // volume of the corner that the plane cuts off
        };
        double below = 0; // inclusion and exclusion over the box's corners, side 5
        for (int bits = 0; bits < 8; ++bits) {
            const double off = 5.0 * ((bits & 1) + 2 * (bits >> 1 & 1) + 3 * (bits >> 2));
            const int sides = (bits & 1) + (bits >> 1 & 1) + (bits >> 2);
            below += (sides % 2 ? -1 : 1) * corner(isovalue - off);
        }
        const MeasuredSurface found = measured(field, {Instant(0), isovalue});
        EXPECT_NEAR(value_of(found, "volume-below"), below, 1e-6);
        EXPECT_NEAR(value_of(found, "volume"), 125 - below, 1e-6);
        EXPECT_EQ(value_of(found, "pieces"), 1);
        EXPECT_EQ(value_of(found, "bodies"), 1);
        EXPECT_EQ(value_of(found, "euler"), 1) << "a disk";
    }
}

TEST_F(MeasuresTest, OfKnownShapesComeNearTheirFormulas) {
    const double pi = std::numbers::pi;
    const auto torus_at = [](double cx) {
        return [cx](double x, double y, double z, double) {
            const double ring = std::hypot(x - cx, y - 20) - 11;
            return 4 - std::hypot(ring, z - 8);
        };
    };
    const auto ball = [](double x, double y, double z, double) {
        return 7 - std::hypot(x - 20.3, y - 19.6, z - 8.1);
    };
    struct Shape {
        TestField::Function function;
        double euler, area, volume;
    };
    const auto two = [&](double x, double y, double z, double t) {
        return std::max(torus_at(17)(x, y, z, t), torus_at(39)(x, y, z, t));
    };
    for (const auto& [function, euler, area, volume] :
         {Shape{ball, 2, 4 * pi * 49, 4 * pi / 3 * 343},
          Shape{torus_at(20), 0, 4 * pi * pi * 11 * 4, 2 * pi * pi * 11 * 16},
          Shape{two, -2, 0, 0}}) {
        const TestField field({57, 41, 17}, 1, ValueType::f32, function);
        const MeasuredSurface found = measured(field, {Instant(0), 0}, {.pieces = true});
        EXPECT_EQ(value_of(found, "euler"), euler);
        ASSERT_EQ(found.pieces.size(), 1u);
        EXPECT_TRUE(found.pieces[0].closed);
        EXPECT_EQ(found.pieces[0].euler, euler);
        EXPECT_NEAR(found.pieces[0].volume, value_of(found, "volume"),
                    1e-9 * value_of(found, "volume"))
            << "by the divergence theorem";
        if (area > 0) {
            EXPECT_NEAR(value_of(found, "area"), area, 0.02 * area);
            EXPECT_NEAR(value_of(found, "volume"), volume, 0.02 * volume);
        }
        // If values are distances, the volume grows with the level as the area says (coarea).
        const double step = 1.0 / 16;
        const double more = value_of(measured(field, {Instant(0), -step}), "volume");
        const double less = value_of(measured(field, {Instant(0), step}), "volume");
        EXPECT_NEAR((more - less) / (2 * step), value_of(found, "area"),
                    0.02 * value_of(found, "area"));
    }
}

TEST_F(MeasuresTest, OfRoughClosedSurfacesObeyTheDivergenceTheorem) {
    // All 256 cases occur, those with four cut edges on a face among them.
    for (const ValueType type : kAllTypes) {
        const Vertices n{12, 10, 11};
        const TestField::Function noise = scaled(white_noise(random_), 100, 10);
        const TestField field(n, 1, type, [&](double x, double y, double z, double t) {
            const bool inner =
                x > 0 && y > 0 && z > 0 && x < n[0] - 1 && y < n[1] - 1 && z < n[2] - 1;
            return inner ? noise(x, y, z, t) : -100;
        });
        const Grid grid = placed(n, random_() % 2 != 0, random_);
        const MeasuredSurface found = *SurfaceMeasures(indexed_at(field.view(), grid))
                                           .measure({Instant(0), 13.3}, {.pieces = true});
        double sum = 0;
        for (const MeasuredPiece& piece : found.pieces)
            sum += piece.volume;
        EXPECT_GT(found.pieces.size(), 5u);
        EXPECT_EQ(value_of(found, "border-edges"), 0);
        EXPECT_NEAR(value_of(found, "volume"), sum, 1e-9 * sum);
    }
}

TEST_F(MeasuresTest, OfPiecesAddUpAndHolesAreNegative) {
    // A shell: a ball with a hollow, and a small ball beside it.
    const TestField field(
        {41, 25, 25}, 1, ValueType::f32, [](double x, double y, double z, double) {
            const double r = std::hypot(x - 12, y - 12, z - 12);
            return std::max(3 - std::abs(r - 7), 2.5 - std::hypot(x - 33, y - 12, z - 12));
        });
    const MeasuredSurface found = measured(field, {Instant(0), 0}, {.pieces = true});
    ASSERT_EQ(found.pieces.size(), 3u);
    EXPECT_EQ(value_of(found, "bodies"), 2);
    EXPECT_GT(found.pieces[0].volume, 0);
    EXPECT_LT(found.pieces[1].volume, 0) << "the hollow";
    EXPECT_GT(found.pieces[2].volume, 0);
    double sum = 0, area = 0;
    for (const MeasuredPiece& piece : found.pieces) {
        sum += piece.volume;
        area += piece.area;
    }
    EXPECT_NEAR(sum, value_of(found, "volume"), 1e-9 * sum);
    EXPECT_NEAR(area, value_of(found, "area"), 1e-9 * area);
    EXPECT_NEAR(found.pieces[2].centroid[0], 33, 0.02);
    EXPECT_NEAR(found.pieces[2].low[0], 30.5, 0.2);
    EXPECT_NEAR(found.pieces[2].high[0], 35.5, 0.2);
}

TEST_F(MeasuresTest, AreTheSameBitsByChunksAndAsAWholeAndBetweenSteps) {
    const Vertices n{37, 41, 39};
    const TestField field(n, 2, ValueType::f32, turbulence(random_));
    const Grid grid = placed(n, true, random_);
    for (const Instant at : {Instant(0), Instant(0, 20000)}) {
        const Query query{at, middle(field.view())};
        const auto whole = SurfaceMeasures(indexed_at(field.view(), grid)).measure(query);
        const auto file = indexed_at(field.view(), grid, 1);
        const auto chunks = SurfaceMeasures(file).measure(query);
        for (std::size_t i = 0; i < measures().size(); ++i) {
            if (!std::isnan(whole->values[i])) {
                EXPECT_EQ(whole->values[i], chunks->values[i]) << measures()[i].name;
            }
        }
        // Sides follow from the mesh alone, and from the values.
        SurfaceMeshes meshes(file);
        const auto mesh = meshes.make_packed(query);
        EXPECT_EQ(VertexSides::of_mesh(*mesh, grid, false),
                  VertexSides::of_values(step_of_query(*file, at, {&query.isovalue, 1}),
                                         query.isovalue, {}));
    }
}

TEST_F(MeasuresTest, InABoxAreThoseOfASeriesOfItsValuesAlone) {
    for (int round = 0; round < 24; ++round) {
        const Vertices n{19, 35, 17};
        TestField field(n, 2, ValueType::f32,
                        round % 2 ? scaled(white_noise(random_), 3, 0)
                                  : scaled(turbulence(random_), 3, 0));
        for (std::size_t i = 0; round % 4 > 1 && i < std::size_t{19} * 35 * 17; ++i)
            if (random_() % 30 == 0)
                field.at<float>(0, i) = static_cast<float>(kNaN);
        const Grid grid = placed(n, round % 3 == 0, random_);
        VertexBox box;
        Vertices size{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.first[axis] = static_cast<std::uint32_t>(random_()) % (n[axis] - 1);
            size[axis] =
                2 + static_cast<std::uint32_t>(random_()) % (n[axis] - box.first[axis] - 1);
            box.last[axis] = box.first[axis] + size[axis] - 1;
        }
        TestField part(size, 2, ValueType::f32, [](double, double, double, double) { return 0; });
        for (std::size_t step = 0, i = 0; step < 2; ++step, i = 0)
            for (std::uint32_t z = box.first[2]; z <= box.last[2]; ++z)
                for (std::uint32_t y = box.first[1]; y <= box.last[1]; ++y)
                    for (std::uint32_t x = box.first[0]; x <= box.last[0]; ++x)
                        part.at<float>(step, i++) =
                            field.at<float>(step, (std::size_t{z} * n[1] + y) * n[0] + x);
        Grid alone = grid.part(box.first, {box.last[0] + 1, box.last[1] + 1, box.last[2] + 1});
        alone.origin = grid.physical({box.first[0], box.first[1], box.first[2]});
        const Query query{round % 3 ? Instant(0) : Instant(0, 20000), 0.05};
        const auto found = *SurfaceMeasures(indexed_at(field.view(), grid))
                                .measure(query, {.box = box, .pieces = true});
        const auto wanted =
            *SurfaceMeasures(indexed_at(part.view(), alone)).measure(query, {.pieces = true});
        for (std::size_t i = 0; i < measures().size(); ++i)
            if (!std::isnan(wanted.values[i])) {
                EXPECT_NEAR(found.values[i], wanted.values[i],
                            1e-9 * (1 + std::abs(wanted.values[i])))
                    << measures()[i].name;
            }
        ASSERT_EQ(found.pieces.size(), wanted.pieces.size());
        for (std::size_t i = 0; i < found.pieces.size(); ++i) {
            EXPECT_NEAR(found.pieces[i].area, wanted.pieces[i].area, 1e-9);
            for (std::size_t axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(found.pieces[i].low[axis], wanted.pieces[i].low[axis], 1e-9);
        }
    }
}

TEST_F(MeasuresTest, OfNoSurfaceAreZeroAndWhole) {
    const TestField field({5, 4, 3}, 1, ValueType::u8,
                          [](double x, double, double, double) { return 10 + x; });
    for (const double isovalue : {5.0, 10.0, 14.5, 300.0, -1e300, kNaN}) {
        const MeasuredSurface found = measured(field, {Instant(0), isovalue});
        EXPECT_EQ(value_of(found, "area"), 0);
        EXPECT_EQ(value_of(found, "pieces"), 0);
        EXPECT_EQ(value_of(found, "volume"), isovalue <= 10 ? 24 : 0) << isovalue;
        EXPECT_EQ(value_of(found, "bodies"), isovalue <= 10 ? 1 : 0);
    }
}

TEST_F(MeasuresTest, OfAnotherArrayAreMeansByArea) {
    // The surface is the plane x = 4.5, and the other array is y there.
    const TestField field({10, 9, 8}, 1, ValueType::f32,
                          [](double x, double, double, double) { return x; });
    const TestField other({10, 9, 8}, 1, ValueType::f32,
                          [](double, double y, double, double) { return 3 * y; });
    MemorySeries series(field.view()), colors(other.view());
    build_index(series, folder_.path() / "b.isochron", {.color = &colors});
    const auto file = IndexFile::open(folder_.path() / "b.isochron");
    const auto found = SurfaceMeasures(file).measure({Instant(0), 4.5}, {.array = 0});
    EXPECT_NEAR(value_of(*found, "mean"), 12, 1e-6);
    EXPECT_EQ(value_of(*found, "least"), 0);
    EXPECT_EQ(value_of(*found, "greatest"), 24);
    const auto without = SurfaceMeasures(file).measure({Instant(0), 4.5});
    EXPECT_TRUE(std::isnan(value_of(*without, "mean")));
}

TEST_F(MeasuresTest, AreStopped) {
    const TestField field({40, 40, 40}, 1, ValueType::f32, turbulence(random_));
    std::stop_source stop;
    stop.request_stop();
    EXPECT_FALSE(SurfaceMeasures(indexed(folder_, field.view()))
                     .measure({Instant(0), 0.0}, {}, stop.get_token()));
}

/// A plane through the middle third of a grid's box, turned at random.
CutPlane plane_through(const Grid& grid, std::mt19937& random) {
    const auto within = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 32>(random);
    };
    std::array<double, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        at[axis] = within(0.3, 0.7) * (grid.vertices[axis] - 1);
    return {grid.physical({at[0], at[1], at[2]}),
            glm::normalize(glm::dvec3(within(-1, 1), within(-1, 1), within(-1, 1)))};
}

CutPlane opposite(CutPlane plane) {
    plane.normal = -plane.normal;
    return plane;
}

TEST_F(MeasuresTest, OfBothSidesOfAPlaneAddUpToTheWhole) {
    for (int round = 0; round < 40; ++round) {
        const Vertices n{15, 12, 17};
        TestField field(n, 1, kAllTypes[static_cast<std::size_t>(round) % kAllTypes.size()],
                        round % 2 ? scaled(white_noise(random_), 100, 10)
                                  : scaled(turbulence(random_), 100, 10));
        const bool gaps = round % 3 == 0 && field.view().type == ValueType::f32;
        for (std::size_t i = 0; gaps && i < std::size_t{15} * 12 * 17; ++i)
            if (random_() % 30 == 0)
                field.at<float>(0, i) = static_cast<float>(kNaN);
        const Grid grid = placed(n, round % 4 == 0, random_);
        const auto file = indexed_at(field.view(), grid);
        SurfaceMeasures measuring(file);
        const Query query{Instant(0), ties(field.view(), 3)[1]};
        CutPlane plane = plane_through(grid, random_);
        if (round % 5 == 0) // across an axis, through vertices
            plane = {grid.physical({7, 6, 8}),
                     glm::normalize(glm::cross(grid.direction[0], grid.direction[1]))};
        const MeasuredSurface whole = *measuring.measure(query);
        const MeasuredSurface left = *measuring.measure(query, {.clip = plane, .pieces = true});
        const MeasuredSurface cut_off = *measuring.measure(query, {.clip = opposite(plane)});
        for (const char* const name : {"area", "volume", "volume-below"}) {
            SCOPED_TRACE(name);
            const double all = value_of(whole, name);
            EXPECT_NEAR(value_of(left, name) + value_of(cut_off, name), all, 1e-9 * all);
        }
        double area = 0;
        for (const MeasuredPiece& piece : left.pieces)
            area += piece.area;
        EXPECT_NEAR(area, value_of(left, "area"), 1e-9 * (1 + area));
        EXPECT_EQ(value_of(left, "pieces"), static_cast<double>(left.pieces.size()));
    }
}

TEST_F(MeasuresTest, LeftByAPlaneThroughVerticesAreThoseInTheBoxOnThatSide) {
    for (int round = 0; round < 24; ++round) {
        const Vertices n{17, 14, 19};
        const TestField field(n, 1, ValueType::f32,
                              round % 2 ? scaled(white_noise(random_), 3, 0)
                                        : scaled(turbulence(random_), 3, 0));
        Grid grid{.vertices = n, .origin = {100, -3, 20}, .spacing = {0.5, 2.0, 0.75}};
        const std::size_t axis = random_() % 3;
        const std::uint32_t at = 2 + static_cast<std::uint32_t>(random_()) % (n[axis] - 4);
        const bool low = random_() % 2 != 0; // the side that is left
        VertexBox box{{0, 0, 0}, {n[0] - 1, n[1] - 1, n[2] - 1}};
        (low ? box.last : box.first)[axis] = at;
        CutPlane plane;
        std::array<std::uint32_t, 3> place{};
        place[axis] = at;
        plane.point = grid.physical({place[0], place[1], place[2]});
        plane.normal = glm::dvec3(0);
        plane.normal[static_cast<int>(axis)] = low ? 1 : -1;
        SurfaceMeasures measuring(indexed_at(field.view(), grid));
        const Query query{Instant(0), 0.05};
        const MeasuredSurface boxed = *measuring.measure(query, {.box = box});
        const MeasuredSurface left = *measuring.measure(query, {.clip = plane});
        for (const Measure& each : measures()) {
            SCOPED_TRACE(each.name);
            const double expected = value_of(boxed, each.name);
            if (is_measured(each, false, false)) {
                EXPECT_NEAR(value_of(left, each.name), expected, 1e-9 * std::abs(expected));
            }
        }
    }
}

TEST_F(MeasuresTest, DistancesAreThoseOfTheNearestOfManyPointsOnTheSurface) {
    for (int round = 0; round < 6; ++round) {
        const Vertices n{11, 9, 8};
        const TestField field(n, 1, ValueType::f32, turbulence(random_));
        const Grid grid = placed(n, true, random_);
        const auto file = indexed_at(field.view(), grid);
        const Query query{Instant(0), middle(field.view())};
        std::uniform_real_distribution<double> any(-0.3, 1.3);
        const glm::dvec3 from =
            grid.physical(glm::dvec3(any(random_) * 10, any(random_) * 8, any(random_) * 7));
        const double found =
            value_of(*SurfaceMeasures(file).measure(query, {.from = from}), "distance");
        const SurfaceMesh mesh = mesh_of(file, query);
        const auto at = [&](std::uint32_t corner) {
            const auto& [x, y, z] = mesh.points[corner];
            return glm::dvec3(x, y, z);
        };
        constexpr int kParts = 40; // along each side
        double nearest = kInfinity, longest = 0;
        for (const auto& [a, b, c] : mesh.triangles) {
            longest = std::max({longest, glm::distance(at(a), at(b)), glm::distance(at(a), at(c))});
            for (int i = 0; i <= kParts; ++i)
                for (int k = 0; i + k <= kParts; ++k) {
                    const glm::dvec3 point = at(a) + (at(b) - at(a)) * (i / double{kParts}) +
                                             (at(c) - at(a)) * (k / double{kParts});
                    nearest = std::min(nearest, glm::distance(from, point));
                }
        }
        EXPECT_LE(found, nearest + 1e-3 * (1 + nearest));
        EXPECT_GE(found, nearest - longest / kParts);
        EXPECT_TRUE(std::isnan(value_of(*SurfaceMeasures(file).measure(query), "distance")));
    }
    // From the middle of the plane x = 4.5, less the side of it that a plane cuts away.
    const TestField field({10, 9, 8}, 1, ValueType::f32,
                          [](double x, double, double, double) { return x; });
    SurfaceMeasures measuring(indexed(folder_, field.view()));
    const auto distance = [&](double isovalue, const std::optional<CutPlane>& clip) {
        return value_of(
            *measuring.measure({Instant(0), isovalue}, {.clip = clip, .from = {{1, 4, 3}}}),
            "distance");
    };
    EXPECT_NEAR(distance(4.5, {}), 3.5, 1e-6);
    EXPECT_NEAR(distance(4.5, CutPlane{{0, 2, 0}, {0, 1, 0}}), std::hypot(3.5, 2.0), 1e-6);
    EXPECT_TRUE(std::isnan(distance(300, {}))) << "no surface";
}

TEST_F(MeasuresTest, LeftOfABallByAPlaneAreThoseOfItsCap) {
    const double pi = std::numbers::pi, radius = 14;
    const glm::dvec3 middle(20.2, 19.7, 20.4), normal = glm::normalize(glm::dvec3(1, -2, 0.7));
    const TestField field({41, 41, 41}, 1, ValueType::f32,
                          [&](double x, double y, double z, double) {
                              return radius - glm::length(glm::dvec3(x, y, z) - middle);
                          });
    SurfaceMeasures measuring(indexed(folder_, field.view()));
    for (const double off : {-9.0, -3.0, 0.0, 5.5, 11.0}) {
        const double height = radius + off; // that of the cap that is left
        const CutPlane plane{middle + off * normal, 3.0 * normal};
        const MeasuredSurface left =
            *measuring.measure({Instant(0), 0.0}, {.clip = plane, .pieces = true});
        const double area = 2 * pi * radius * height;
        EXPECT_NEAR(value_of(left, "area"), area, 0.01 * area);
        const double volume = pi * height * height * (3 * radius - height) / 3;
        EXPECT_NEAR(value_of(left, "volume"), volume, 0.01 * volume);
        EXPECT_EQ(value_of(left, "euler"), 1) << "a disk";
        ASSERT_EQ(left.pieces.size(), 1u);
        EXPECT_FALSE(left.pieces[0].closed);
    }
}

} // namespace
} // namespace isochron::index
