// OBJ (Wavefront, "Advanced Visualizer Manual", appendix B1): an object for each surface, colors
// after the coordinates, as MeshLab and Blender read them.
#include "index/export/buffered_sink.h"
#include "index/export/surface_writer.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

#include <iterator>

namespace isochron::index {
namespace {

class ObjWriter : public SurfaceWriter {
  public:
    ObjWriter(const ExportPlan& plan, std::filesystem::path name)
        : plan_(plan), name_(std::move(name)) {}

    void add(const ExportedStep& step) override {
        NewFile file(file_of_step(name_, plan_, step.instant.step));
        BufferedSink out(file);
        const ExportedPlaces places(*step.grid, plan_);
        out.text(fmt::format("# {}\n# {}\n# {}\n", plan_.note, words_of(plan_, step),
                             words_of(plan_, places)));
        std::uint64_t first = 1;
        for (std::size_t i = 0; i < step.surfaces.size(); ++i) {
            out.text(
                fmt::format("o surface_{}\n# surface {}: {}\n", i + 1, i, step.surfaces[i].name));
            put(step.surfaces[i], places, first, out);
            first += step.surfaces[i].mesh->vertices();
        }
        out.flush();
        file.commit();
    }

  private:
    void put(const ExportedSurface& surface, const ExportedPlaces& places, std::uint64_t first,
             BufferedSink& out) const {
        fmt::memory_buffer line;
        const auto end_line = [&] {
            out.text({line.data(), line.size()});
            line.clear();
        };
        constexpr float kFull = 255;
        surface.mesh->each_vertex([&](const MeshVertex& vertex, float value) {
            const glm::dvec3 at = places.of(vertex);
            const auto color = surface.color_at(value);
            if (plan_.double_precision)
                fmt::format_to(std::back_inserter(line), "v {} {} {}", at.x, at.y, at.z);
            else
                fmt::format_to(std::back_inserter(line), "v {} {} {}", float(at.x), float(at.y),
                               float(at.z));
            fmt::format_to(std::back_inserter(line), " {:.4g} {:.4g} {:.4g}\n", color[0] / kFull,
                           color[1] / kFull, color[2] / kFull);
            if (plan_.normals) {
                const glm::vec3 normal(normal_of(vertex));
                fmt::format_to(std::back_inserter(line), "vn {:.6g} {:.6g} {:.6g}\n", normal.x,
                               normal.y, normal.z);
            }
            end_line();
        });
        surface.mesh->each_triangle([&](const auto& corners) {
            line.push_back('f');
            for (const std::uint32_t corner : places.triangle(corners)) {
                const std::uint64_t number = first + corner;
                if (plan_.normals)
                    fmt::format_to(std::back_inserter(line), " {}//{}", number, number);
                else
                    fmt::format_to(std::back_inserter(line), " {}", number);
            }
            line.push_back('\n');
            end_line();
        });
    }

    ExportPlan plan_;
    std::filesystem::path name_;
};

} // namespace

std::unique_ptr<SurfaceWriter> obj_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name) {
    return std::make_unique<ObjWriter>(plan, name);
}

} // namespace isochron::index
