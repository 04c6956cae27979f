// VTK's XML PolyData with raw appended data (Kitware, "VTK File Formats"), and a .pvd of the times.
#include "index/export/buffered_sink.h"
#include "index/export/surface_writer.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

#include <utility>

namespace isochron::index {
namespace {

/// Text as it may stand in an attribute or a comment of XML.
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text)
        switch (c) {
        case '&': out += "&amp;"; break;
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '"': out += "&quot;"; break;
        case '-': out += "&#45;"; break; // two of them end a comment
        default: out += c;
        }
    return out;
}

class VtpWriter : public SurfaceWriter {
  public:
    VtpWriter(const ExportPlan& plan, std::filesystem::path name)
        : plan_(plan), name_(std::move(name)) {}

    void add(const ExportedStep& step) override {
        const std::filesystem::path path = file_of_step(name_, plan_, step.instant.step);
        NewFile file(path);
        BufferedSink out(file);
        write(step, out);
        out.flush();
        file.commit();
        times_.emplace_back(step.time, path.filename().string());
    }

    void finish() override {
        if (plan_.steps.size() < 2)
            return;
        NewFile file(std::filesystem::path(name_).replace_extension(".pvd"));
        BufferedSink out(file);
        out.text("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
                 "<Collection>\n");
        for (const auto& [time, part] : times_)
            out.text(fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time,
                                 escaped(part)));
        out.text("</Collection>\n</VTKFile>\n");
        out.flush();
        file.commit();
    }

  private:
    /// The elements that name the arrays, with the places of their bytes.
    class Arrays {
      public:
        std::string add(std::string_view type, std::string_view name, int components,
                        std::uint64_t bytes) {
            std::string text = fmt::format(
                "<DataArray type=\"{}\" Name=\"{}\"{} format=\"appended\" offset=\"{}\"/>\n", type,
                escaped(name),
                components > 1 ? fmt::format(" NumberOfComponents=\"{}\"", components) : "",
                offset_);
            offset_ += sizeof(std::uint64_t) + bytes;
            return text;
        }

      private:
        std::uint64_t offset_ = 0;
    };

    void write(const ExportedStep& step, BufferedSink& out) const {
        std::uint64_t vertices = 0, triangles = 0;
        for (const ExportedSurface& surface : step.surfaces) {
            vertices += surface.mesh->vertices();
            triangles += surface.mesh->triangles();
        }
        const ExportedPlaces places(*step.grid, plan_);
        const bool wide = plan_.double_precision, valued = !plan_.values_name.empty();
        const std::uint64_t place_bytes = vertices * 3 * (wide ? 8 : 4);
        Arrays arrays;
        std::string text = fmt::format(
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<!-- {}; {} -->\n"
            "<PolyData>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
            "NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n</FieldData>\n"
            "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
            "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n<PointData{}{}>\n",
            escaped(plan_.note), escaped(words_of(plan_, places)), step.time, vertices, triangles,
            valued ? fmt::format(" Scalars=\"{}\"", escaped(plan_.values_name)) : "",
            plan_.normals ? " Normals=\"Normals\"" : "");
        if (plan_.normals)
            text += arrays.add("Float32", "Normals", 3, vertices * 12);
        if (valued)
            text += arrays.add("Float32", plan_.values_name, 1, vertices * 4);
        text += arrays.add("UInt8", "color", 3, vertices * 3);
        text += arrays.add("UInt8", "surface", 1, vertices);
        text += "</PointData>\n<Points>\n";
        text += arrays.add(wide ? "Float64" : "Float32", "Points", 3, place_bytes);
        text += "</Points>\n<Polys>\n";
        text += arrays.add("Int64", "connectivity", 1, triangles * 24);
        text += arrays.add("Int64", "offsets", 1, triangles * 8);
        text += "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
        out.text(text);
        put_points(step, vertices, out);
        out.put(place_bytes);
        each_vertex(step, [&](const MeshVertex& vertex, float, std::size_t) {
            const glm::dvec3 at = places.of(vertex);
            if (wide)
                out.put(at);
            else
                out.put(glm::vec3(at));
        });
        out.put(triangles * 24);
        std::int64_t first = 0;
        for (const ExportedSurface& surface : step.surfaces) {
            surface.mesh->each_triangle([&](const auto& corners) {
                for (const std::uint32_t corner : places.triangle(corners))
                    out.put(first + corner);
            });
            first += static_cast<std::int64_t>(surface.mesh->vertices());
        }
        out.put(triangles * 8);
        for (std::uint64_t i = 1; i <= triangles; ++i)
            out.put(3 * i);
        out.text("\n</AppendedData>\n</VTKFile>\n");
    }

    /// What is said of each vertex beside its place.
    void put_points(const ExportedStep& step, std::uint64_t vertices, BufferedSink& out) const {
        if (plan_.normals) {
            out.put(vertices * 12);
            each_vertex(step, [&](const MeshVertex& vertex, float, std::size_t) {
                out.put(glm::vec3(normal_of(vertex)));
            });
        }
        if (!plan_.values_name.empty()) {
            out.put(vertices * 4);
            each_vertex(step, [&](const MeshVertex&, float value, std::size_t) { out.put(value); });
        }
        out.put(vertices * 3);
        each_vertex(step, [&](const MeshVertex&, float value, std::size_t number) {
            out.put(step.surfaces[number].color_at(value));
        });
        out.put(vertices);
        each_vertex(step, [&](const MeshVertex&, float, std::size_t number) {
            out.put(static_cast<std::uint8_t>(number));
        });
    }

    template <class Use>
    static void each_vertex(const ExportedStep& step, Use&& use) {
        for (std::size_t number = 0; number < step.surfaces.size(); ++number)
            step.surfaces[number].mesh->each_vertex(
                [&](const MeshVertex& vertex, float value) { use(vertex, value, number); });
    }

    ExportPlan plan_;
    std::filesystem::path name_;
    std::vector<std::pair<double, std::string>> times_;
};

} // namespace

std::unique_ptr<SurfaceWriter> vtp_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name) {
    return std::make_unique<VtpWriter>(plan, name);
}

} // namespace isochron::index
