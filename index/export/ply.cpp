// PLY (G. Turk, "The PLY Polygon File Format", 1994), binary: all surfaces of a step in one file,
// with the number of its surface at each vertex.
#include "index/export/buffered_sink.h"
#include "index/export/surface_writer.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

namespace isochron::index {
namespace {

class PlyWriter : public SurfaceWriter {
  public:
    PlyWriter(const ExportPlan& plan, std::filesystem::path name)
        : plan_(plan), name_(std::move(name)) {}

    void add(const ExportedStep& step) override {
        NewFile file(file_of_step(name_, plan_, step.instant.step));
        BufferedSink out(file);
        const ExportedPlaces places(*step.grid, plan_);
        out.text(header(step, places));
        for (std::size_t i = 0; i < step.surfaces.size(); ++i)
            put_vertices(step.surfaces[i], static_cast<std::uint8_t>(i), places, out);
        std::uint32_t first = 0;
        for (const ExportedSurface& surface : step.surfaces) {
            surface.mesh->each_triangle([&](const auto& corners) {
                out.put(std::uint8_t{3});
                for (const std::uint32_t corner : places.triangle(corners))
                    out.put(first + corner);
            });
            first += static_cast<std::uint32_t>(surface.mesh->vertices());
        }
        out.flush();
        file.commit();
    }

  private:
    std::string header(const ExportedStep& step, const ExportedPlaces& places) const {
        std::uint64_t vertices = 0, triangles = 0;
        std::string named;
        for (std::size_t i = 0; i < step.surfaces.size(); ++i) {
            vertices += step.surfaces[i].mesh->vertices();
            triangles += step.surfaces[i].mesh->triangles();
            named += fmt::format("comment surface {}: {}\n", i, step.surfaces[i].name);
        }
        const char* const place = plan_.double_precision ? "double" : "float";
        return fmt::format(
            "ply\nformat binary_little_endian 1.0\ncomment {}\n"
            "comment {}\ncomment {}\n{}"
            "element vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n{}"
            "property uchar red\nproperty uchar green\nproperty uchar blue\n{}"
            "property uchar surface\n"
            "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
            plan_.note, words_of(plan_, step), words_of(plan_, places), named, vertices, place,
            place, place,
            plan_.normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
            plan_.values_name.empty() ? "" : "property float value\n", triangles);
    }

    void put_vertices(const ExportedSurface& surface, std::uint8_t number,
                      const ExportedPlaces& places, BufferedSink& out) const {
        surface.mesh->each_vertex([&](const MeshVertex& vertex, float value) {
            const glm::dvec3 at = places.of(vertex);
            if (plan_.double_precision)
                out.put(at);
            else
                out.put(glm::vec3(at));
            if (plan_.normals)
                out.put(glm::vec3(normal_of(vertex)));
            out.put(surface.color_at(value));
            if (!plan_.values_name.empty())
                out.put(value);
            out.put(number);
        });
    }

    ExportPlan plan_;
    std::filesystem::path name_;
};

} // namespace

std::unique_ptr<SurfaceWriter> ply_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name) {
    return std::make_unique<PlyWriter>(plan, name);
}

} // namespace isochron::index
