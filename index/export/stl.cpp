// STL, binary (3D Systems, "StereoLithography Interface Specification", 1989): 80 bytes of text, the
// number of triangles, then 50 bytes a triangle. It has no objects, so each surface has its file.
#include "index/error.h"
#include "index/export/buffered_sink.h"
#include "index/export/surface_writer.h"
#include "index/system/new_file.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace isochron::index {
namespace {

class StlWriter : public SurfaceWriter {
  public:
    StlWriter(const ExportPlan& plan, std::filesystem::path name)
        : plan_(plan), name_(std::move(name)) {}

    void add(const ExportedStep& step) override {
        for (std::size_t i = 0; i < step.surfaces.size(); ++i)
            write(step, step.surfaces[i],
                  file_of_step(name_, plan_, step.instant.step,
                               step.surfaces.size() > 1 ? std::optional(i) : std::nullopt));
    }

  private:
    void write(const ExportedStep& step, const ExportedSurface& surface,
               const std::filesystem::path& path) const {
        const std::uint64_t triangles = surface.mesh->triangles();
        if (triangles > std::numeric_limits<std::uint32_t>::max())
            throw Error("{}: {} triangles, expected fewer than 2^32 in STL", path.string(),
                        triangles);
        NewFile file(path);
        BufferedSink out(file);
        const ExportedPlaces places(*step.grid, plan_);
        out.text(header(places));
        out.put(static_cast<std::uint32_t>(triangles));
        surface.mesh->each_placed_triangle([&](const std::array<MeshVertex, 3>& vertices) {
            std::array<glm::vec3, 3> corners;
            std::ranges::transform(
                places.triangle(vertices), corners.begin(),
                [&](const MeshVertex& vertex) { return glm::vec3(places.of(vertex)); });
            const glm::dvec3 across = glm::cross(glm::dvec3(corners[1]) - glm::dvec3(corners[0]),
                                                 glm::dvec3(corners[2]) - glm::dvec3(corners[0]));
            const double length = glm::length(across);
            out.put(length > 0 ? glm::vec3(across / length) : glm::vec3(0.0f));
            out.put(corners);
            out.put(std::uint16_t{0});
        });
        out.flush();
        file.commit();
    }

    /// It must not begin with `solid`, by which programs tell STL in text.
    std::string header(const ExportedPlaces& places) const {
        constexpr std::size_t kLength = 80;
        const glm::dvec3& origin = places.origin();
        std::string text = fmt::format("isochron unit={} less origin {} {} {}",
                                       plan_.length_unit.empty() ? "unknown" : plan_.length_unit,
                                       static_cast<float>(origin.x), static_cast<float>(origin.y),
                                       static_cast<float>(origin.z));
        text.resize(kLength, ' ');
        return text;
    }

    ExportPlan plan_;
    std::filesystem::path name_;
};

} // namespace

std::unique_ptr<SurfaceWriter> stl_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name) {
    return std::make_unique<StlWriter>(plan, name);
}

} // namespace isochron::index
