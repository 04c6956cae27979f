// USD as text (OpenUSD, "USDA file format"): a mesh for each surface, whose points and faces are
// samples in time. A time code is a step's place in the export.
#include "index/export/buffered_sink.h"
#include "index/export/surface_writer.h"
#include "index/system/new_file.h"
#include "index/system/scratch_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace isochron::index {
namespace {

/// Text within the quotes of USD.
std::string in_quotes(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += '\\';
        out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
    return out + '"';
}

/// One attribute of a mesh, sample after sample.
class Samples {
  public:
    explicit Samples(const std::filesystem::path& beside) : file_(beside), out_(file_) {}

    void begin(std::size_t time_code) { out_.text(fmt::format("            {}: [", time_code)); }
    void end() {
        out_.text("],\n");
        first_ = true;
    }
    void number(float value) {
        separate();
        append("{}", value);
    }
    void number(std::uint32_t value) {
        separate();
        append("{}", value);
    }
    void place(const glm::dvec3& at) {
        separate();
        append("({}, {}, {})", float(at.x), float(at.y), float(at.z));
    }
    void copy_to(BufferedSink& out) {
        out_.flush();
        out.copy(file_, out_.size());
    }

  private:
    void separate() {
        if (!std::exchange(first_, false))
            out_.text(", ");
    }
    template <class... Values>
    void append(fmt::string_view form, Values... values) {
        text_.clear();
        fmt::vformat_to(std::back_inserter(text_), form, fmt::make_format_args(values...));
        out_.text({text_.data(), text_.size()});
    }

    ScratchFile file_;
    BufferedSink out_;
    fmt::memory_buffer text_;
    bool first_ = true;
};

/// The attributes of one surface.
class MeshSamples {
  public:
    MeshSamples(const ExportedSurface& surface, const std::filesystem::path& beside)
        : name_(surface.name), isovalue_(surface.isovalue), opacity_(surface.opacity),
          extent_(beside), counts_(beside), corners_(beside), points_(beside), normals_(beside),
          colors_(beside), values_(beside) {}

    void add(const ExportPlan& plan, const ExportedSurface& surface, const ExportedPlaces& places,
             std::size_t code) {
        const ExportedMesh& mesh = *surface.mesh;
        glm::dvec3 low(0.0), high(0.0);
        points_.begin(code);
        bool first = true;
        mesh.each_vertex([&](const MeshVertex& vertex, float) {
            const glm::dvec3 at = places.of(vertex);
            low = first ? at : glm::min(low, at);
            high = first ? at : glm::max(high, at);
            first = false;
            points_.place(at);
        });
        points_.end();
        extent_.begin(code);
        extent_.place(low);
        extent_.place(high);
        extent_.end();
        counts_.begin(code);
        corners_.begin(code);
        mesh.each_triangle([&](const auto& corners) {
            counts_.number(std::uint32_t{3});
            for (const std::uint32_t corner : places.triangle(corners))
                corners_.number(corner);
        });
        counts_.end();
        corners_.end();
        if (plan.normals) {
            normals_.begin(code);
            mesh.each_vertex(
                [&](const MeshVertex& vertex, float) { normals_.place(normal_of(vertex)); });
            normals_.end();
        }
        colored_ = surface.color_of;
        const auto put_color = [&](const std::array<std::uint8_t, 3>& c) {
            colors_.place(glm::dvec3(linear_light(c[0]), linear_light(c[1]), linear_light(c[2])));
        };
        colors_.begin(code);
        if (colored_)
            mesh.each_vertex(
                [&](const MeshVertex&, float value) { put_color(surface.color_at(value)); });
        else
            put_color(surface.color);
        colors_.end();
        if (!plan.values_name.empty()) {
            values_.begin(code);
            mesh.each_vertex([&](const MeshVertex&, float value) { values_.number(value); });
            values_.end();
        }
    }

    void write(const ExportPlan& plan, std::size_t number, BufferedSink& out) {
        out.text(fmt::format("    def Mesh \"surface_{}\" (\n        doc = {}\n"
                             "        customData = {{\n            int surface = {}\n"
                             "            double isovalue = {}\n        }}\n    )\n    {{\n"
                             "        uniform token subdivisionScheme = \"none\"\n"
                             "        uniform bool doubleSided = 1\n",
                             number + 1, in_quotes(name_), number, isovalue_));
        put("float3[] extent", {}, extent_, out);
        put("int[] faceVertexCounts", {}, counts_, out);
        put("int[] faceVertexIndices", {}, corners_, out);
        put("point3f[] points", {}, points_, out);
        if (plan.normals)
            put("normal3f[] normals", "interpolation = \"vertex\"", normals_, out);
        put("color3f[] primvars:displayColor",
            colored_ ? "interpolation = \"vertex\"" : "interpolation = \"constant\"", colors_, out);
        if (opacity_ < 1)
            out.text(fmt::format("        float[] primvars:displayOpacity = [{}] (\n"
                                 "            interpolation = \"constant\"\n        )\n",
                                 opacity_));
        if (!plan.values_name.empty())
            put("float[] primvars:value",
                "doc = " + in_quotes(plan.values_name) + "\n            interpolation = \"vertex\"",
                values_, out);
        out.text("    }\n");
    }

  private:
    static void put(std::string_view attribute, const std::string& about, Samples& samples,
                    BufferedSink& out) {
        if (!about.empty()) // declares an attribute without a value
            out.text(fmt::format("        {} (\n            {}\n        )\n", attribute, about));
        out.text(fmt::format("        {}.timeSamples = {{\n", attribute));
        samples.copy_to(out);
        out.text("        }\n");
    }

    std::string name_;
    double isovalue_;
    float opacity_;
    bool colored_ = false;
    Samples extent_, counts_, corners_, points_, normals_, colors_, values_;
};

class UsdaWriter : public SurfaceWriter {
  public:
    UsdaWriter(const ExportPlan& plan, std::filesystem::path name)
        : plan_(plan), name_(std::move(name)) {}

    void add(const ExportedStep& step) override {
        const ExportedPlaces places(*step.grid, plan_);
        origin_ = places.origin();
        for (std::size_t i = 0; i < step.surfaces.size(); ++i) {
            if (meshes_.size() <= i)
                meshes_.push_back(std::make_unique<MeshSamples>(step.surfaces[i], name_));
            meshes_[i]->add(plan_, step.surfaces[i], places, added_);
        }
        times_ += fmt::format("{}{}", added_ == 0 ? "" : ", ", step.time);
        ++added_;
    }

    void finish() override {
        NewFile file(name_);
        BufferedSink out(file);
        out.text(fmt::format(
            "#usda 1.0\n(\n    doc = {}\n    defaultPrim = \"isochron\"\n    metersPerUnit = {}\n"
            "    upAxis = \"Z\"\n    startTimeCode = 0\n    endTimeCode = {}\n"
            "    timeCodesPerSecond = {}\n)\n\ndef Xform \"isochron\" (\n    customData = {{\n"
            "        double3 origin = ({}, {}, {})\n        string lengthUnit = {}\n"
            "        string timeUnit = {}\n        double[] times = [{}]\n    }}\n)\n{{\n",
            in_quotes(plan_.note), plan_.meters, added_ > 0 ? added_ - 1 : 0, plan_.rate, origin_.x,
            origin_.y, origin_.z, in_quotes(plan_.length_unit), in_quotes(plan_.time_unit),
            times_));
        for (std::size_t i = 0; i < meshes_.size(); ++i)
            meshes_[i]->write(plan_, i, out);
        out.text("}\n");
        out.flush();
        file.commit();
    }

  private:
    ExportPlan plan_;
    std::filesystem::path name_;
    std::vector<std::unique_ptr<MeshSamples>> meshes_;
    glm::dvec3 origin_{0.0};
    std::string times_;
    std::size_t added_ = 0;
};

} // namespace

std::unique_ptr<SurfaceWriter> usda_writer(const ExportPlan& plan,
                                           const std::filesystem::path& name) {
    return std::make_unique<UsdaWriter>(plan, name);
}

} // namespace isochron::index
