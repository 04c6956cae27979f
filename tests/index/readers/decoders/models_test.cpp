// Files of triangles in every form, whole and damaged; and those that an export has written.
#include "index/readers/decoders/model/model.h"

#include "index/error.h"
#include "index/export/surface_export.h"
#include "index/interrupted.h"
#include "index/readers/formats/model_file.h"
#include "index/search/surface_mesh.h"
#include "tests/support/indexed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace isochron::index {
namespace {

using testing::HasSubstr;
using Triangle = std::array<glm::dvec3, 3>;

/// Polygons as a file is to state them.
struct Shape {
    std::vector<glm::dvec3> points;
    std::vector<std::vector<std::int64_t>> polygons;

    /// By arithmetic: n - 2 triangles of each, around its first corner.
    std::vector<Triangle> triangles() const {
        std::vector<Triangle> all;
        for (const auto& polygon : polygons)
            for (std::size_t i = 2; i < polygon.size(); ++i)
                all.push_back({points[static_cast<std::size_t>(polygon[0])],
                               points[static_cast<std::size_t>(polygon[i - 1])],
                               points[static_cast<std::size_t>(polygon[i])]});
        return all;
    }
};

/// Two triangles, of coordinates that floats have.
const Shape kTwo{{{0, 0, 0}, {1.5, 0, 0}, {1.5, 2.25, 0.125}, {-4, 2.25, 1e-3f}},
                 {{0, 1, 2}, {0, 2, 3}}};
const Shape kPolygons{
    {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}, {-1, 1, 0}, {0, 0, 5}},
    {{0, 1, 3, 4}, {0, 1, 2, 3, 4, 5}, {6, 1, 0}}};

template <class T>
void put(std::string& out, T value, std::endian order = std::endian::little) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    if (order != std::endian::native)
        std::ranges::reverse(bytes);
    out.append(bytes.data(), bytes.size());
}

std::string stl_binary(const Shape& shape) {
    std::string out = "solid by its first word, though binary";
    out.resize(80, ' ');
    put(out, static_cast<std::uint32_t>(shape.triangles().size()));
    for (const Triangle& triangle : shape.triangles()) {
        for (int i = 0; i < 3; ++i)
            put(out, 0.0f);
        for (const glm::dvec3& corner : triangle)
            for (int axis = 0; axis < 3; ++axis)
                put(out, static_cast<float>(corner[axis]));
        put(out, std::uint16_t{7});
    }
    return out;
}

std::string number(double value) {
    return fmt::format("{}", value);
}
std::string place(const glm::dvec3& at) {
    return number(at.x) + " " + number(at.y) + " " + number(at.z);
}

std::string stl_text(const Shape& shape) {
    std::string out = "solid a name of words\n";
    for (const Triangle& triangle : shape.triangles()) {
        out += " facet normal 0 0 0\n  outer loop\n";
        for (const glm::dvec3& corner : triangle)
            out += "   vertex " + place(corner) + "\n";
        out += "  endloop\n endfacet\n";
    }
    return out + "endsolid\n";
}

std::string obj_text(const Shape& shape) {
    std::string out = "# a comment\nmtllib ../elsewhere.mtl\no thing\n";
    for (const glm::dvec3& point : shape.points)
        out += "v " + place(point) + " 1 0 0\n";
    out += "vt 0 0\nvn 0 0 1\ng all\nusemtl red\ns off\n";
    bool back = false; // numbers from the last point, too
    for (const auto& polygon : shape.polygons) {
        out += "f";
        for (const std::int64_t corner : polygon)
            out += back ? fmt::format(" {}/1/1",
                                      corner - static_cast<std::int64_t>(shape.points.size()))
                        : fmt::format(" {}//1", corner + 1);
        out += "\n";
        back = !back;
    }
    return out;
}

enum class Form { text, little, big };
std::string ply(const Shape& shape, Form form) {
    const char* const kForms[]{"ascii", "binary_little_endian", "binary_big_endian"};
    std::string out = fmt::format(
        "ply\nformat {} 1.0\ncomment c\nelement vertex {}\nproperty uchar red\nproperty float x\n"
        "property double y\nproperty float32 z\nproperty list uchar short more\nelement face {}\n"
        "property list uchar int vertex_indices\nproperty ushort flags\nend_header\n",
        kForms[static_cast<int>(form)], shape.points.size(), shape.polygons.size());
    const auto order = form == Form::big ? std::endian::big : std::endian::little;
    for (const glm::dvec3& point : shape.points) {
        if (form == Form::text) {
            out += "255 " + place(point) + " 2 7 8\n";
            continue;
        }
        put(out, std::uint8_t{255});
        put(out, static_cast<float>(point.x), order);
        put(out, point.y, order);
        put(out, static_cast<float>(point.z), order);
        put(out, std::uint8_t{1});
        put(out, std::int16_t{-3}, order);
    }
    for (const auto& polygon : shape.polygons) {
        if (form == Form::text) {
            out += number(static_cast<double>(polygon.size()));
            for (const std::int64_t corner : polygon)
                out += " " + std::to_string(corner);
            out += " 9\n";
            continue;
        }
        put(out, static_cast<std::uint8_t>(polygon.size()));
        for (const std::int64_t corner : polygon)
            put(out, static_cast<std::int32_t>(corner), order);
        put(out, std::uint16_t{9}, order);
    }
    return out;
}

struct Format {
    const char* name;
    StatedModel (*parse)(std::span<const std::byte>, const std::string&);
    std::string (*write)(const Shape&);
    bool text, indexed;
};
const Format kFormats[]{
    {"a.stl", stl_model, stl_binary, false, false},
    {"b.stl", stl_model, stl_text, true, false},
    {"a.ply", ply_model, [](const Shape& shape) { return ply(shape, Form::text); }, true, true},
    {"b.ply", ply_model, [](const Shape& shape) { return ply(shape, Form::little); }, false, true},
    {"c.ply", ply_model, [](const Shape& shape) { return ply(shape, Form::big); }, false, true},
    {"a.obj", obj_model, obj_text, true, true},
};

StatedModel parsed(const Format& format, const std::string& bytes) {
    return format.parse(std::as_bytes(std::span(bytes)), format.name);
}
std::vector<Triangle> triangles_of(const StatedModel& model) {
    std::vector<Triangle> all;
    for (std::size_t i = 0; i < model.corners.size(); i += 3)
        all.push_back({model.points[model.corners[i]], model.points[model.corners[i + 1]],
                       model.points[model.corners[i + 2]]});
    return all;
}
/// What is said of the file, in one line that names it; empty: it is taken.
std::string complaint(const Format& format, const std::string& bytes) {
    try {
        finished(parsed(format, bytes), format.name);
        return {};
    } catch (const Error& error) {
        const std::string line = error.what();
        EXPECT_EQ(line.find('\n'), std::string::npos);
        EXPECT_TRUE(line.starts_with(format.name)) << line;
        return line;
    }
}

TEST(Models, HaveTheTrianglesThatTheFileStatesInEveryFormat) {
    for (const Format& format : kFormats)
        for (const Shape& shape : {kTwo, kPolygons})
            for (const bool crlf : {false, true}) {
                std::string bytes = format.write(shape);
                for (std::size_t at = 0;
                     crlf && format.text && (at = bytes.find('\n', at)) != std::string::npos;
                     at += 2)
                    bytes.replace(at, 1, "\r\n");
                EXPECT_EQ(triangles_of(parsed(format, bytes)), shape.triangles())
                    << format.name << crlf;
            }
}

TEST(Models, RefuseNumbersThatAreNoneAndCornersThatAreNoPoints) {
    const double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const Format& format : kFormats) {
        for (const double bad : {kNan, std::numeric_limits<double>::infinity(), 3e38}) {
            Shape shape = kTwo;
            shape.points[2].y = bad;
            EXPECT_THAT(complaint(format, format.write(shape)), HasSubstr("coordinate"))
                << format.name << bad;
        }
        if (!format.indexed)
            continue;
        for (const std::int64_t beyond : {4, 100000, -1}) {
            std::string bytes = format.write(kTwo);
            if (format.text) { // a corner of the second face
                const std::string last =
                    bytes.ends_with("9\n") ? "0 2 3 9" : "-4/1/1 -2/1/1 -1/1/1";
                const std::string to = last.ends_with('9')
                                           ? fmt::format("0 2 {} 9", beyond)
                                           : fmt::format("-4 -2 {}", beyond < 0 ? -5 : beyond + 1);
                bytes.replace(bytes.find(last), last.size(), to);
            } else {
                std::string as_int;
                put(as_int, static_cast<std::int32_t>(beyond),
                    format.name[0] == 'c' ? std::endian::big : std::endian::little);
                bytes.replace(bytes.size() - 6, 4, as_int);
            }
            EXPECT_THAT(complaint(format, bytes), HasSubstr("corner at point")) << format.name;
        }
    }
}

TEST(Models, AreRefusedWhereverTheyAreCutOff) {
    for (const Format& format : kFormats) {
        const std::string whole = format.write(kTwo);
        const std::vector<Triangle> all = triangles_of(parsed(format, whole));
        const std::size_t blanks = whole.size() - (whole.find_last_not_of("\r\n") + 1);
        for (std::size_t size = 0; size + (format.text ? blanks : 0) < whole.size(); ++size) {
            const std::string said = complaint(format, whole.substr(0, size));
            if (!said.empty())
                continue;
            // OBJ has no end: what is there of it must be the beginning.
            ASSERT_STREQ(format.name, "a.obj") << size;
            const auto some = triangles_of(parsed(format, whole.substr(0, size)));
            EXPECT_LE(some.size(), all.size());
            EXPECT_EQ(some.front(), all.front());
        }
    }
}

TEST(Models, SayWhatIsWrong) {
    const auto says = [](std::size_t number, const std::string& bytes) {
        return complaint(kFormats[number], bytes);
    };
    EXPECT_THAT(says(0, stl_binary(kTwo) + "x"), HasSubstr("expected 184 bytes, got 185"));
    EXPECT_THAT(says(1, "solid\nfacet\nvertex 0 0\n"), HasSubstr("line 3: expected a coordinate"));
    EXPECT_THAT(says(1, "solid\nendsolid\n"), HasSubstr("no triangles (0 points)"));
    EXPECT_THAT(says(2, "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\n"
                        "property float y\nproperty float z\nend_header\n0 0 0\n"),
                HasSubstr("ends within vertex 1: expected 4000000000"));
    EXPECT_THAT(says(2, "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n"),
                HasSubstr("lacks a place"));
    EXPECT_THAT(says(2, "ply\nformat ascii 1.0\nelement face 1\nproperty list int int "
                        "vertex_indices\nend_header\n2000000000 1\n"),
                HasSubstr("a list of 2000000000"));
    EXPECT_THAT(says(2, "obj\n"), HasSubstr("line 1: expected 'ply'"));
    EXPECT_THAT(says(5, "v 0 0 0\nf 1 1\n"), HasSubstr("a face of 2 corners"));
    EXPECT_THAT(says(5, "v 0 0 0\nf 1 0 1\n"), HasSubstr("from 1, got 0"));
    EXPECT_THAT(says(5, "v 0 0\n"), HasSubstr("line 1: expected a coordinate"));
    EXPECT_THAT(says(5, std::string(64, '\xff')), HasSubstr("no triangles"));
}

/// A cube has edges, a fine ball has none.
TEST(Models, AreSmoothButAtEdges) {
    Shape cube;
    for (int i = 0; i < 8; ++i)
        cube.points.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    cube.polygons = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                     {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    for (const Format& format : kFormats) {
        const TriangleMesh mesh = finished(parsed(format, format.write(cube)), format.name);
        EXPECT_EQ(mesh.points.size(), 24u); // three at each corner
        for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
            const glm::vec3 normal = glm::abs(mesh.normals[mesh.corners[i]]);
            EXPECT_NEAR(std::max({normal.x, normal.y, normal.z}), 1, 1e-6);
        }
    }
    Shape ball;
    constexpr int kAround = 32, kUp = 16;
    for (int up = 1; up < kUp; ++up)
        for (int i = 0; i < kAround; ++i) {
            const double a = 2 * M_PI * i / kAround, b = M_PI * up / kUp;
            ball.points.emplace_back(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a),
                                     std::cos(b));
        }
    for (int up = 0; up + 2 < kUp; ++up)
        for (int i = 0; i < kAround; ++i) {
            const int next = (i + 1) % kAround;
            std::vector<std::int64_t> quad{up * kAround + i, up * kAround + next,
                                           (up + 1) * kAround + next, (up + 1) * kAround + i};
            if (i % 3 == 0) // in the other order
                std::ranges::reverse(quad);
            ball.polygons.push_back(quad);
        }
    const TriangleMesh mesh = finished(parsed(kFormats[2], kFormats[2].write(ball)), "a.ply");
    ASSERT_EQ(mesh.points.size(), ball.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        EXPECT_GT(std::abs(glm::dot(glm::dvec3(mesh.normals[i]),
                                    mesh.origin + glm::dvec3(mesh.points[i]))),
                  0.97);
}

/// A surface that is exported and shown as a model lies on the surface.
TEST(Models, OfAnExportLieOnTheSurface) {
    const test_support::TestFolder folder;
    Grid oblique{.vertices = {12, 9, 10}, .origin = {-3, 2, 1}, .spacing = {0.5, 0.2, 1.5}};
    oblique.direction = glm::dmat3(glm::dvec3(0.8, 0.6, 0), glm::dvec3(-0.6, 0.8, 0),
                                   glm::normalize(glm::dvec3(0.3, 0.1, 1)));
    Grid far = oblique;
    far.origin = {4.1e6, -7.3e5, 12};
    const TestField field({12, 9, 10}, 1, ValueType::f32, [](double x, double y, double z, double) {
        return std::hypot(x - 5.3, y - 4.1, z - 4.7);
    });
    for (const Grid& grid : {oblique, far})
        for (const char* name : {"a.stl", "a.ply", "a.obj", "double.ply", "double.obj", "a.vtp"}) {
            StepValues values = field.view();
            values.grid = grid;
            const auto file = indexed(folder, values);
            ExportRequest request;
            request.plan.steps = {0};
            request.plan.double_precision = std::string(name).starts_with("double");
            request.surfaces = {{.isovalue = 3.2, .name = "s"}};
            const auto path = folder.path() / name;
            if (name == std::string("a.vtp") && grid.origin.x > 1e6)
                continue; // VTK reads no comments, in which VTP has the origin
            export_surfaces(file, *surface_format_of(path), path, request);
            const TriangleMesh model = read_model(path);
            const auto mesh = SurfaceMeshes(file).make_packed({Instant(0), 3.2});
            ASSERT_EQ(model.corners.size(), mesh->triangles.size()) << name;
            double most = 0;
            for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
                const glm::dvec3 expected =
                    grid.physical(position_of(mesh->vertices[mesh->triangles[i]]));
                const glm::dvec3 at = model.origin + glm::dvec3(model.points[model.corners[i]]);
                double nearest = glm::distance(at, expected); // corners of a triangle may be turned
                for (std::size_t k = 3 * (i / 3); k < 3 * (i / 3) + 3; ++k)
                    nearest = std::min(
                        nearest,
                        glm::distance(model.origin + glm::dvec3(model.points[model.corners[k]]),
                                      expected));
                most = std::max(most, nearest);
            }
            // Half a step of floats in the file, along three axes, and half a step of the mesh's own.
            EXPECT_LT(most, 16 * 2 * std::sqrt(3.0) * std::numeric_limits<float>::epsilon())
                << name;
        }
}

/// A quadrilateral; and a triangle in meters with y upwards.
TEST(Models, AreReadByVtkToo) {
    const test_support::TestFolder folder;
    const auto vtp = [](const char* corners) {
        return fmt::format(
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\"><PolyData>"
            "<Piece NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
            "NumberOfStrips=\"0\" "
            "NumberOfPolys=\"1\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
            "format=\"ascii\">0 0 0 2 0 0 2 2 0 0 2 0</DataArray></Points><Polys><DataArray "
            "type=\"Int64\" Name=\"connectivity\" format=\"ascii\">{}</DataArray><DataArray "
            "type=\"Int64\" Name=\"offsets\" "
            "format=\"ascii\">4</DataArray></Polys></Piece></PolyData>"
            "</VTKFile>",
            corners);
    };
    const TriangleMesh quad = read_model(folder.write("a.vtp", vtp("0 1 2 3")));
    EXPECT_EQ(quad.triangles(), 2u);
    EXPECT_EQ(bounds(quad), (std::array{glm::dvec3(0), glm::dvec3(2, 2, 0)}));
    EXPECT_THROW(read_model(folder.write("b.vtp", vtp("0 1 2 9"))), Error);
    EXPECT_THROW(read_model(folder.write("c.vtp", vtp("0 1 2 -7"))), Error);
    // (1, 2, 3), (2, 2, 3), (1, 4, 3.5) as floats
    folder.write("a.gltf",
                 R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
                 R"("nodes":[{"mesh":0,"translation":[10,0,0]}],)"
                 R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                 R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
                 R"("min":[1,2,3],"max":[2,4,3.5]}],)"
                 R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
                 R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
                 R"(AACAPwAAAEAAAEBAAAAAQAAAAEAAAEBAAACAPwAAgEAAAGBA"}]})");
    const TriangleMesh turned = read_model(folder.path() / "a.gltf", "mm");
    ASSERT_EQ(turned.triangles(), 1u);
    const glm::dvec3 expected[]{{11, -3, 2}, {12, -3, 2}, {11, -3.5, 4}};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LT(glm::distance(turned.origin + glm::dvec3(turned.points[turned.corners[i]]),
                                1000.0 * expected[i]),
                  1e-3);
}

TEST(Models, AreReadBehindTheFenceAndRefusedInOneLine) {
    const test_support::TestFolder folder;
    for (const Format& format : kFormats)
        folder.write(format.name, format.write(kPolygons));
    for (const Format& format : kFormats)
        EXPECT_EQ(read_model(folder.path() / format.name).triangles(),
                  kPolygons.triangles().size());
    const auto said = [&](const std::string& name) -> std::string {
        try {
            read_model(folder.path() / name);
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return error.what();
        }
        return {};
    };
    folder.write("cut.stl", stl_binary(kTwo).substr(0, 150));
    EXPECT_THAT(said("cut.stl"), HasSubstr("expected 184 bytes, got 150"));
    EXPECT_THAT(said("none.stl"), HasSubstr("there is no such file"));
    EXPECT_THAT(said("a.nrrd"), HasSubstr("expected .stl, .ply, .obj, .vtp, .gltf, .glb"));
    for (const char* name : {"bad.vtp", "bad.glb", "bad.gltf"}) {
        folder.write(name, "<VTKFile type=\"PolyData\"><Poly");
        EXPECT_THAT(said(name), HasSubstr(name));
    }
}

TEST(Models, AreNotWaitedForOnceNobodyWantsThem) {
    const test_support::TestFolder folder;
    const auto file = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::stop_source nobody;
    nobody.request_stop();
    EXPECT_THROW(read_model(file, "", nobody.get_token()), Interrupted);
    EXPECT_EQ(read_model(file).triangles(), 1u) << "by another reader";
}

} // namespace
} // namespace isochron::index
