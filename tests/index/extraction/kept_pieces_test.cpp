// Pieces that a filter keeps, against a flood over the edges of the whole mesh.
#include "index/measure/kept_pieces.h"

#include "index/detail/detail_regions.h"
#include "index/extraction/extraction.h"
#include "index/measure/measures.h"
#include "index/surface/mesh_cases.h"
#include "tests/support/indexed.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace isochron::index {
namespace {

using test_support::TestFolder;

constexpr std::uint64_t kRoom = std::uint64_t{1} << 30;
using Corners = std::array<MeshVertex, 3>;

/// The nearest of the triangle's points: on its plane, else on a side, else a corner.
double far_from(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    double least = kInfinity;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 a = t[i], side = t[(i + 1) % 3] - a;
        const double length = glm::dot(side, side);
        const double s = length > 0 ? glm::dot(p - a, side) / length : 0;
        least = std::min(least, glm::distance(p, a + std::clamp(s, 0.0, 1.0) * side));
    }
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    if (glm::length(normal) == 0)
        return least;
    const double height = glm::dot(p - t[0], glm::normalize(normal));
    const glm::dvec3 foot = p - height * glm::normalize(normal);
    bool within = true;
    for (std::size_t i = 0; i < 3; ++i)
        within &= glm::dot(glm::cross(t[(i + 1) % 3] - t[i], foot - t[i]), normal) >= 0;
    return within ? std::min(least, std::abs(height)) : least;
}

/// The pieces of a surface, by a flood from triangle to triangle over the edges that they share.
struct Flood {
    const CellMesh& mesh;
    const Grid& grid;
    std::vector<std::size_t> piece, cell; ///< by triangle
    std::vector<std::set<std::size_t>> cells;

    Flood(const CellMesh& of, const Grid& in) : mesh(of), grid(in) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> by_edge;
        const auto edge = [&](std::size_t triangle, std::size_t k) {
            return std::minmax(mesh.triangles[3 * triangle + k],
                               mesh.triangles[3 * triangle + (k + 1) % 3]);
        };
        for (std::size_t c = 0; c < mesh.cases.size(); ++c)
            cell.insert(cell.end(), mesh_cases()[mesh.cases[c]].triangles, c);
        for (std::size_t i = 0; i < cell.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                by_edge[edge(i, k)].push_back(i);
        constexpr auto kNone = static_cast<std::size_t>(-1);
        piece.assign(cell.size(), kNone);
        for (std::size_t start = 0; start < cell.size(); ++start) {
            if (piece[start] != kNone)
                continue;
            std::vector<std::size_t> next{start};
            piece[start] = cells.size();
            cells.emplace_back();
            while (!next.empty()) {
                const std::size_t i = next.back();
                next.pop_back();
                cells.back().insert(cell[i]);
                for (std::size_t k = 0; k < 3; ++k)
                    for (const std::size_t other : by_edge[edge(i, k)])
                        if (piece[other] == kNone) {
                            piece[other] = piece[start];
                            next.push_back(other);
                        }
            }
        }
    }
    std::array<glm::dvec3, 3> corners(std::size_t i) const {
        std::array<glm::dvec3, 3> at;
        for (std::size_t k = 0; k < 3; ++k)
            at[k] = grid.physical(position_of(mesh.vertices[mesh.triangles[3 * i + k]]));
        return at;
    }
    /// The piece nearest to a place, and how far the nearest one of another piece is.
    struct Near {
        std::size_t piece = 0;
        double distance = kInfinity, next = kInfinity;
    };
    Near nearest(const glm::dvec3& place) const {
        std::vector<double> far(cells.size(), kInfinity);
        for (std::size_t i = 0; i < cell.size(); ++i)
            far[piece[i]] = std::min(far[piece[i]], far_from(place, corners(i)));
        Near near;
        for (std::size_t i = 0; i < far.size(); ++i)
            if (far[i] < near.distance)
                near = {i, far[i], near.distance};
            else
                near.next = std::min(near.next, far[i]);
        return near;
    }
    std::vector<bool> kept(const PieceFilter& filter, std::size_t surface) const {
        std::vector<bool> kept(cells.size(), true);
        const auto here = [&](const PieceAt& at) { return at.surface == surface; };
        const bool only = std::ranges::any_of(filter.only, here);
        for (std::size_t i = 0; i < kept.size(); ++i)
            kept[i] = !only && cells[i].size() >= filter.dust;
        for (const PieceAt& at : filter.only)
            if (here(at) && !cells.empty())
                kept[nearest(at.place).piece] = true;
        for (const PieceAt& at : filter.hidden)
            if (here(at) && !cells.empty() && nearest(at.place).distance < 1e-6)
                kept[nearest(at.place).piece] = false;
        return kept;
    }
};

bool same(const MeshVertex& a, const MeshVertex& b) {
    return a == b;
}

/// The corners of triangles, with the places and normals of vertices in place of their numbers.
std::vector<Corners> triangles_of(const CellMesh& mesh, const std::vector<bool>& wanted = {}) {
    std::vector<Corners> all;
    for (std::size_t i = 0; 3 * i < mesh.triangles.size(); ++i)
        if (wanted.empty() || wanted[i])
            all.push_back({mesh.vertices[mesh.triangles[3 * i]],
                           mesh.vertices[mesh.triangles[3 * i + 1]],
                           mesh.vertices[mesh.triangles[3 * i + 2]]});
    return all;
}

/// Compares an extraction with what a flood keeps of the whole one. @return pieces that were hidden
std::size_t expect_kept(const Extraction& found, const Extraction& whole, const Grid& grid) {
    std::size_t all = 0, left = 0;
    for (std::size_t s = 0; s < whole.surfaces.size(); ++s) {
        const CellSet &from = whole.surfaces[s], &to = found.surfaces[s];
        std::vector<CellId> ids;
        std::vector<CellPoint> points;
        const PieceFilter& filter = found.query.pieces;
        const auto concerns = [&](const PieceAt& at) { return at.surface == s; };
        const bool asked = filter.dust > 0 || std::ranges::any_of(filter.only, concerns) ||
                           std::ranges::any_of(filter.hidden, concerns);
        if (!from.mesh) {
            EXPECT_TRUE(to.ids.empty());
            continue;
        }
        const Flood flood(*from.mesh, grid);
        const std::vector<bool> kept = flood.kept(filter, s);
        if (asked) {
            all += kept.size();
            left += static_cast<std::size_t>(std::ranges::count(kept, true));
        }
        std::vector<bool> triangles, cells(from.ids.size());
        for (std::size_t i = 0; i < flood.piece.size(); ++i) {
            triangles.push_back(kept[flood.piece[i]]);
            cells[flood.cell[i]] = cells[flood.cell[i]] || triangles.back();
        }
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (cells[i]) {
                ids.push_back(from.ids[i]);
                if (!to.points.empty())
                    points.push_back(from.points[i]);
            }
        EXPECT_EQ(to.ids, ids) << "surface " << s;
        EXPECT_TRUE(std::ranges::equal(to.points, points, [](const auto& a, const auto& b) {
            return a.x == b.x && a.y == b.y && a.z == b.z && a.plane == b.plane;
        }));
        std::size_t row = 0;
        for (std::size_t i = 0; i < to.points.size(); ++i) {
            if (i == 0 || to.points[i].y != to.points[i - 1].y ||
                to.points[i].z != to.points[i - 1].z) {
                EXPECT_EQ(to.rows.at(row++).begin, i);
            }
        }
        EXPECT_EQ(to.rows.size(), row);
        if (!to.mesh)
            continue;
        EXPECT_EQ(to.mesh->cases.size(), ids.size()); // renderers find cells of triangles by these
        std::size_t of_cases = 0;
        for (const std::uint8_t which : to.mesh->cases)
            of_cases += mesh_cases()[which].triangles;
        EXPECT_EQ(3 * of_cases, to.mesh->triangles.size());
        const auto expected = triangles_of(*from.mesh, triangles), there = triangles_of(*to.mesh);
        EXPECT_TRUE(std::ranges::equal(
            there, expected,
            [](const Corners& a, const Corners& b) { return std::ranges::equal(a, b, same); }))
            << "surface " << s;
    }
    EXPECT_EQ(found.pieces.all, all);
    EXPECT_EQ(found.pieces.kept, left);
    return all - left;
}

/// Waves with noise on them: surfaces of many pieces, some of which meet in a cell.
TestField::Function rough(std::mt19937& random) {
    return [waves = turbulence(random, 24), noise = white_noise(random)](double x, double y,
                                                                         double z, double t) {
        return 0.6 * waves(x, y, z, t) + 0.4 * noise(x, y, z, t);
    };
}

/// An index of a random field on a sheared grid, with gaps if wished.
std::shared_ptr<const IndexFile> field_in(const TestFolder& folder, TestField& field, bool gaps,
                                          std::mt19937& random) {
    const std::size_t vertices = field.view().grid.vertex_count();
    for (int i = 0; gaps && i < 40; ++i)
        field.at<float>(random() % 3, random() % vertices) = static_cast<float>(kNaN);
    MemorySeries series(field.view());
    Grid& grid = series.info().grid;
    grid.origin = {100, -3, 20};
    grid.spacing = {0.5, 2.0, 0.75};
    grid.direction = glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0),
                                glm::normalize(glm::dvec3(0.3, 0, 1)));
    build_index(series, folder.path() / "a.isochron", {});
    return IndexFile::open(folder.path() / "a.isochron");
}

/// A place on the mesh, which only one piece comes near.
std::optional<glm::dvec3> place_on(const CellMesh& mesh, const Grid& grid, std::mt19937& random) {
    if (mesh.triangles.empty())
        return std::nullopt;
    const Flood flood(mesh, grid);
    const auto at = flood.corners(random() % flood.cell.size());
    const glm::dvec3 place = (at[0] + at[1] + at[2]) / 3.0;
    return flood.nearest(place).next > 1e-6 ? std::optional(place) : std::nullopt;
}

TEST(KeptPieces, AreThoseOfAFloodOverTheEdgesOfTheMeshForAllTypes) {
    std::mt19937 random(test_seed());
    std::size_t hidden = 0, between = 0, shared = 0;
    for (const ValueType type : kAllTypes) {
        for (const bool gaps : {false, true}) {
            if (gaps && type != ValueType::f32)
                continue;
            const TestFolder folder;
            TestField field({13, 11, 9}, 3, type, scaled(rough(random), 60, 3));
            const auto file = field_in(folder, field, gaps, random);
            const Grid& grid = file->info().grid;
            const auto isovalues = quantiles(sorted_values(field.view()), 7);
            const Extract of_points = extract_from(file, std::nullopt, Shading::cells),
                          of_ids = extract_from(file, std::nullopt, Shading::none);
            for (int i = 0; i < tries(36); ++i) {
                SurfacesQuery query{Instant(static_cast<std::uint32_t>(random() % 3)),
                                    {isovalues[random() % 7]}};
                if (query.instant.step < 2 && i % 2 == 0)
                    query.instant.fraction = static_cast<std::uint32_t>(1 + random() % 65'000);
                if (random() % 2)
                    query.isovalues.push_back(isovalues[random() % 7]);
                query.mesh_room = kRoom;
                const ExtractionPtr whole =
                    extract_from(file, std::nullopt, Shading::cells)(query, {});
                query.pieces.dust = std::array{0u, 2u, 6u, 40u}[random() % 4];
                for (std::uint32_t s = 0; s < query.isovalues.size(); ++s)
                    for (auto* const list : {&query.pieces.only, &query.pieces.hidden})
                        if (random() % 3 == 0 && whole->surfaces[s].mesh)
                            if (const auto at = place_on(*whole->surfaces[s].mesh, grid, random))
                                list->push_back({s, *at});
                if (random() % 3 == 0)
                    query.mesh_room = 0;
                const bool points = random() % 2;
                const ExtractionPtr found = (points ? of_points : of_ids)(query, {});
                ASSERT_EQ(found->query, query);
                if (!query.pieces.keeps_all())
                    hidden += expect_kept(*found, *whole, grid);
                ASSERT_EQ(found->meshed() && found->cells() > 0,
                          query.mesh_room > 0 && points && found->cells() > 0);
                ASSERT_FALSE(testing::Test::HasFailure()) << name_of(type) << ' ' << i;
                between += query.instant.between();
                for (const CellSet& set : whole->surfaces)
                    if (set.mesh) {
                        const Flood flood(*set.mesh, grid);
                        std::size_t in_pieces = 0;
                        for (const auto& cells : flood.cells)
                            in_pieces += cells.size();
                        shared += in_pieces - set.mesh->cases.size();
                    }
            }
        }
    }
    EXPECT_GT(hidden, static_cast<std::size_t>(tries(700)));
    EXPECT_GT(between, static_cast<std::size_t>(tries(20)));
    EXPECT_GT(shared, static_cast<std::size_t>(tries(200))); // cells in which pieces meet
}

TEST(KeptPieces, ComeNearestToAPlaceAndHideOnlyWithinTwoCells) {
    std::mt19937 random(test_seed());
    const TestFolder folder;
    TestField field({20, 18, 16}, 3, ValueType::f32, rough(random));
    const auto file = field_in(folder, field, false, random);
    const Grid& grid = file->info().grid;
    SurfacesQuery query{Instant(1), {0.3}};
    query.mesh_room = kRoom;
    const Extract extract = extract_from(file, std::nullopt, Shading::cells);
    const ExtractionPtr whole = extract(query, {});
    const CellMesh& mesh = *whole->surfaces[0].mesh;
    const Flood flood(mesh, grid);
    ASSERT_GT(flood.cells.size(), 3u);
    std::size_t near = 0, far = 0;
    for (int i = 0; i < 60; ++i) {
        const auto along = [&](std::uint32_t count) {
            return std::uniform_real_distribution<double>(-6.0, count + 5.0)(random);
        };
        const glm::dvec3 index(along(20), along(18), along(16)), place = grid.physical(index);
        const Flood::Near nearest = flood.nearest(place);
        if (nearest.next - nearest.distance < 1e-6)
            continue;
        query.pieces = {.only = {{0, place}}, .hidden = {}};
        EXPECT_EQ(extract(query, {})->surfaces[0].ids.size(), flood.cells[nearest.piece].size());
        // How many cells away the nearest triangle is, along the axis where that is most.
        double cells = kInfinity;
        for (std::size_t t = 0; t < flood.cell.size(); ++t) {
            if (far_from(place, flood.corners(t)) > nearest.distance + 1e-9)
                continue;
            glm::dvec3 low(kInfinity), high(-kInfinity);
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 at = position_of(mesh.vertices[mesh.triangles[3 * t + k]]);
                low = glm::min(low, at);
                high = glm::max(high, at);
            }
            const glm::dvec3 off = glm::max(low - index, index - high);
            cells = std::min(cells, std::max({off.x, off.y, off.z}));
        }
        query.pieces = {.only = {}, .hidden = {{0, place}}};
        const ExtractionPtr found = extract(query, {});
        EXPECT_EQ(found->pieces.kept, flood.cells.size() - (cells <= 2 ? 1 : 0)) << cells;
        ++(cells <= 2 ? near : far);
    }
    EXPECT_GT(near, 5u);
    EXPECT_GT(far, 5u);
}

TEST(KeptPieces, ComeAndGoWhileStepsAndFiltersChangeAsIfMadeAnew) {
    std::mt19937 random(test_seed());
    const TestFolder folder;
    TestField field({13, 11, 9}, 3, ValueType::f32, scaled(rough(random), 60, 3));
    const auto file = field_in(folder, field, false, random);
    const auto isovalues = quantiles(sorted_values(field.view()), 5);
    const Extract kept = extract_from(file, std::nullopt, Shading::cells);
    SurfacesQuery query{Instant(0), {isovalues[2], isovalues[3]}};
    query.mesh_room = kRoom;
    std::size_t reused = 0;
    for (int i = 0; i < 60; ++i) {
        switch (random() % 4) {
        case 0: query.pieces.dust = std::array{0u, 3u, 9u}[random() % 3]; break;
        case 1: query.instant.step = static_cast<std::uint32_t>(random() % 3); break;
        case 2: query.isovalues[0] = isovalues[random() % 5]; break;
        default: query.coloring = random() % 2 ? CellColoring::first_crossing : CellColoring::none;
        }
        const ExtractionPtr found = kept(query, {});
        const ExtractionPtr anew = extract_from(file, std::nullopt, Shading::cells)(query, {});
        reused += found->reused();
        ASSERT_EQ(found->colors, anew->colors);
        ASSERT_EQ(found->blocks.ids, anew->blocks.ids);
        ASSERT_EQ(found->blocks.joined(), anew->blocks.joined());
        ASSERT_EQ(found->pieces.kept, anew->pieces.kept);
        ASSERT_EQ(found->volume_cells, anew->volume_cells);
        for (std::size_t s = 0; s < 2; ++s) {
            ASSERT_EQ(found->surfaces[s].ids, anew->surfaces[s].ids) << i;
            const CellMeshPtr a = found->surfaces[s].mesh, b = anew->surfaces[s].mesh;
            ASSERT_TRUE(a && b ? *a == *b : a == b) << i;
        }
    }
    EXPECT_GT(reused, 1000u);
}

TEST(KeptPieces, AreWhatCellsOfCoarserLevelsStandFor) {
    std::mt19937 random(test_seed());
    const TestFolder folder;
    const TestField field({66, 52, 49}, 1, ValueType::f32, rough(random));
    const auto file = indexed(folder, field.view(), {.tiers = TierSet().with(Tier::bricks)});
    SurfacesQuery query{Instant(0), {0.3}};
    query.coloring = CellColoring::first_crossing;
    query.pieces.dust = 100;
    const Extract extract = extract_from(file, std::nullopt, Shading::none);
    const ExtractionPtr exact = extract(query, {});
    SurfacesQuery all = query;
    all.pieces = {};
    const ExtractionPtr whole = extract(all, {});
    ASSERT_LT(exact->cells() + 300, whole->cells());
    query.detail.most_cells = exact->cells(); // all that is kept fits
    EXPECT_EQ(extract(query, {})->surfaces[0].ids, exact->surfaces[0].ids);
    query.detail.most_cells = exact->cells() / 3;
    all.detail = query.detail;
    const ExtractionPtr coarse = extract(query, {}), unfiltered = extract(all, {});
    ASSERT_TRUE(coarse->coarse()) << exact->cells() << " of " << whole->cells() << " unfiltered "
                                  << unfiltered->coarse() << ": " << unfiltered->cells();
    EXPECT_EQ(coarse->volume_cells, exact->cells());
    EXPECT_EQ(coarse->colors.size(), coarse->cells());
    EXPECT_LT(coarse->cells(), unfiltered->cells());
    const std::set<CellId> shown(exact->surfaces[0].ids.begin(), exact->surfaces[0].ids.end());
    const std::set<CellId> there(whole->surfaces[0].ids.begin(), whole->surfaces[0].ids.end());
    const auto cells = file->info().grid.cells();
    /// How many of some cells lie in a cell of a level, and in those around it.
    const auto count = [&](const std::set<CellId>& of, const CellPoint& point,
                           std::int64_t around) {
        const unsigned level = level_of_center(point.x);
        const std::int64_t edge = std::int64_t{1} << level;
        std::size_t found = 0;
        std::array<std::int64_t, 3> low{}, end{};
        for (std::size_t a = 0; a < 3; ++a) {
            const std::int64_t at = std::array{point.x, point.y, point.z}[a] >> (level + 1);
            low[a] = std::max<std::int64_t>((at - around) * edge, 0);
            end[a] = std::min<std::int64_t>((at + 1 + around) * edge, cells[a]);
        }
        for (std::int64_t z = low[2]; z < end[2]; ++z)
            for (std::int64_t y = low[1]; y < end[1]; ++y)
                for (std::int64_t x = low[0]; x < end[0]; ++x)
                    found += of.contains(static_cast<CellId>(x + cells[0] * (y + cells[1] * z)));
        return found;
    };
    std::size_t next = 0;
    for (const CellPoint& point : unfiltered->surfaces[0].points) {
        const bool stands = count(shown, point, 0) > 0 ||
                            (count(there, point, 0) == 0 && count(shown, point, 1) > 0);
        const auto& points = coarse->surfaces[0].points;
        const bool kept = next < points.size() && points[next].x == point.x &&
                          points[next].y == point.y && points[next].z == point.z;
        ASSERT_EQ(kept, stands) << point.x << ' ' << point.y << ' ' << point.z;
        next += kept;
    }
    EXPECT_EQ(next, coarse->cells());
}

TEST(KeptPieces, OfTwoSpheresMeasureAsTheOneAlone) {
    const auto sphere = [](double x, double y, double z, double at, double radius) {
        return radius - std::sqrt((x - at) * (x - at) + (y - 9) * (y - 9) + (z - 9) * (z - 9));
    };
    for (const double second : {31.1, 38.6}) { // the border of the grid cuts the second one
        const TestFolder one_folder, two_folder;
        const TestField one(
            {40, 19, 19}, 1, ValueType::f64,
            [&](double x, double y, double z, double) { return sphere(x, y, z, 10.3, 6.2); }),
            two({40, 19, 19}, 1, ValueType::f64, [&](double x, double y, double z, double) {
                return std::max(sphere(x, y, z, 10.3, 6.2), sphere(x, y, z, second, 2.4));
            });
        SurfaceMeasures of_one(indexed(one_folder, one.view())),
            of_two(indexed(two_folder, two.view()));
        const MeasuredSurface alone = *of_one.measure({{}, 0.0}),
                              both = *of_two.measure({{}, 0.0}, {.pieces = true}),
                              kept = *of_two.measure(
                                  {{}, 0.0}, {.pieces = true,
                                              .kept = {.only = {}, .hidden = {}, .dust = 300}});
        ASSERT_EQ(both.pieces.size(), 2u);
        EXPECT_EQ(both.pieces[1].closed, second < 35);
        ASSERT_EQ(kept.pieces.size(), 1u);
        EXPECT_EQ(static_cast<double>(kept.pieces[0].cells), alone.values[0]);
        EXPECT_LT(both.pieces[1].cells, 300u);
        EXPECT_EQ(both.pieces[0].cells, kept.pieces[0].cells);
        for (std::size_t i = 0; i < measures().size(); ++i) {
            if (measures()[i].name == "bodies") {
                EXPECT_TRUE(std::isnan(kept.values[i]));
            } else if (!std::isnan(alone.values[i])) {
                EXPECT_NEAR(kept.values[i], alone.values[i], 1e-9 * std::abs(alone.values[i]))
                    << measures()[i].name;
            }
        }
        for (const MeasuredPiece& piece : both.pieces) { // on a sphere, whose triangles lie within
            const double at = &piece == both.pieces.data() ? 10.3 : second,
                         radius = &piece == both.pieces.data() ? 6.2 : 2.4;
            EXPECT_NEAR(sphere(piece.place[0], piece.place[1], piece.place[2], at, radius), 0,
                        0.15);
        }
    }
}

} // namespace
} // namespace isochron::index
