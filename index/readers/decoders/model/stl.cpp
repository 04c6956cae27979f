// STL in both forms (3D Systems, "StereoLithography Interface Specification", 1989). The normals that
// it states are left out.
#include "index/readers/decoders/model/model.h"

#include "index/lower_case.h"
#include "index/readers/decoders/model/model_text.h"

#include <array>
#include <cstring>

namespace isochron::index {
namespace {

constexpr std::size_t kStlHeader = 80, kStlTriangle = 50, kStlCorners = 12; ///< [byte]

StatedModel stl_in_binary(std::span<const std::byte> bytes, const std::string& name) {
    std::uint32_t count = 0;
    std::memcpy(&count, &bytes[kStlHeader], sizeof count);
    const std::uint64_t expected = kStlHeader + sizeof count + kStlTriangle * std::uint64_t{count};
    if (bytes.size() != expected)
        throw Error("{}: STL of {} triangles: expected {} bytes, got {}", name, count, expected,
                    bytes.size());
    StatedModel model;
    const std::string_view header(reinterpret_cast<const char*>(bytes.data()), kStlHeader);
    if (header.starts_with("isochron "))
        take_origin(header, true, model.origin);
    model.points.reserve(std::size_t{3} * count);
    for (std::size_t i = 0; i < count; ++i) {
        std::array<glm::vec3, 3> corners;
        std::memcpy(corners.data(),
                    &bytes[kStlHeader + sizeof count + kStlTriangle * i + kStlCorners],
                    sizeof corners);
        for (const glm::vec3& corner : corners) {
            model.corners.push_back(static_cast<std::uint32_t>(model.points.size()));
            model.points.emplace_back(corner);
        }
    }
    return model;
}

StatedModel stl_in_text(std::span<const std::byte> bytes, const std::string& name) {
    StatedModel model;
    ModelText text(bytes, name);
    std::size_t corners = 0; // corners of this triangle so far
    bool in_facet = false, in_solid = false;
    while (text.next_line()) {
        const std::string word = lower_case(text.word());
        if (word == "vertex") {
            if (!in_facet || corners == 3)
                text.fail("a vertex, expected three in each facet");
            const auto along = [&] { return text.number<double>("a coordinate"); };
            const double x = along(), y = along(), z = along();
            model.corners.push_back(static_cast<std::uint32_t>(model.points.size()));
            model.points.emplace_back(x, y, z);
            ++corners;
        } else if (word == "facet" || word == "endfacet") {
            if (in_facet != (word == "endfacet") || (in_facet && corners != 3))
                text.fail(
                    fmt::format("'{}' after {} corners: expected facets of three vertices, one "
                                "after the other",
                                word, corners));
            in_facet = !in_facet;
            corners = 0;
        } else if (word == "solid" || word == "endsolid") {
            in_solid = word == "solid";
        } else if (!word.empty() && word != "outer" && word != "endloop") {
            text.fail(fmt::format("'{}', expected STL: solid, facet, outer loop, vertex, ...",
                                  ModelText::shortened(word)));
        }
    }
    if (in_facet || in_solid)
        text.fail("the file ends within a solid: expected endsolid");
    return model;
}

} // namespace

/// A binary file may begin with `solid`, too: its length tells, or its zeros.
StatedModel stl_model(std::span<const std::byte> bytes, const std::string& name) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    const bool solid =
        first != std::string_view::npos && lower_case(text.substr(first, 5)) == "solid";
    if (bytes.size() < kStlHeader + 4) {
        if (solid)
            return stl_in_text(bytes, name);
        throw Error("{}: {} bytes, expected STL: 'solid', or a header of 84 bytes", name,
                    bytes.size());
    }
    std::uint32_t count = 0;
    std::memcpy(&count, &bytes[kStlHeader], sizeof count);
    const bool fits =
        bytes.size() == kStlHeader + sizeof count + kStlTriangle * std::uint64_t{count};
    constexpr std::size_t kLooked = 1024;
    const bool zeros = text.substr(0, kLooked).find('\0') != std::string_view::npos;
    return solid && !fits && !zeros ? stl_in_text(bytes, name) : stl_in_binary(bytes, name);
}

} // namespace isochron::index
