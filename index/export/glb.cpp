// GLB (Khronos, "glTF 2.0 Specification", section 4): a node for each surface, and in an animation
// one for each step, whose scale is 1 while the step is shown and 0 at other times. glTF has y
// upwards and meters: the node at the root turns and scales what stands in the unit of the file.
#include "index/error.h"
#include "index/export/buffered_sink.h"
#include "index/export/glb_views.h"
#include "index/export/surface_writer.h"
#include "index/system/new_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace isochron::index {
namespace {

using json = nlohmann::ordered_json;

// Numbers of the specification.
constexpr int kFloat = 5126, kUint = 5125, kUbyte = 5121, kUshort = 5123, kByte = 5120;
constexpr std::uint32_t kMagic = 0x46546C67, kJson = 0x4E4F534A, kBinary = 0x004E4942;

/// One file that is being written.
class GlbFile {
  public:
    GlbFile(const ExportPlan& plan, std::filesystem::path path)
        : plan_(plan), path_(std::move(path)), binary_(path_, plan.packing) {
        document_["asset"] = {{"version", "2.0"}, {"generator", plan.note}};
        for (const char* list : {"scenes", "nodes", "meshes", "materials", "accessors"})
            document_[list] = json::array();
        // Turns z upwards to y upwards.
        constexpr double kHalf = 0.7071067811865476;
        const double m = plan.meters;
        document_["nodes"].push_back({{"name", "isochron"},
                                      {"rotation", {-kHalf, 0.0, 0.0, kHalf}},
                                      {"scale", {m, m, m}},
                                      {"children", json::array()}});
        document_["scenes"].push_back({{"nodes", {0}}});
        document_["scene"] = 0;
        for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
            if (plan.quantized)
                document_[list].push_back("KHR_mesh_quantization");
            if (plan.packing)
                document_[list].push_back(GlbViews::kPacked);
        }
    }

    /// @return number of the step's node
    std::size_t add(const ExportedStep& step) {
        const ExportedPlaces places(*step.grid, plan_);
        const glm::dvec3& origin = places.origin();
        json children = json::array();
        for (std::size_t i = 0; i < step.surfaces.size(); ++i)
            if (step.surfaces[i].mesh->triangles() > 0) // meshes of glTF have triangles
                children.push_back(add(step.surfaces[i], i, places));
        json node{{"name", "step " + number_text(step.instant)},
                  {"extras",
                   {{"time", step.time},
                    {"time_unit", plan_.time_unit},
                    {"length_unit", plan_.length_unit},
                    {"origin", {origin.x, origin.y, origin.z}}}}};
        if (!children.empty())
            node["children"] = std::move(children);
        const std::size_t number = push("nodes", std::move(node));
        document_["nodes"][0]["children"].push_back(number);
        return number;
    }

    /// Shows each of these nodes in its turn.
    void animate(const std::vector<std::size_t>& nodes) {
        json samplers = json::array(), channels = json::array();
        const double each = 1 / plan_.rate;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const bool first = i == 0, last = i + 1 == nodes.size();
            std::vector<float> times, scales;
            const auto key = [&](double time, float scale) {
                times.push_back(static_cast<float>(time));
                scales.insert(scales.end(), 3, scale);
            };
            if (!first)
                key(0, 0);
            key(each * static_cast<double>(i), 1);
            key(each * static_cast<double>(i + 1), last ? 1 : 0);
            const auto end = static_cast<float>(each * static_cast<double>(nodes.size()));
            if (!last && i + 2 < nodes.size()) // all end together
                key(end, 0);
            const std::size_t at = binary_.begin();
            for (const float time : times)
                binary_.put_plain(time);
            const std::size_t input =
                accessor(binary_.end_plain(at), kFloat, times.size(), "SCALAR");
            document_["accessors"][input]["min"] = {times.front()};
            document_["accessors"][input]["max"] = {times.back()};
            const std::size_t from = binary_.begin();
            for (const float scale : scales)
                binary_.put_plain(scale);
            const std::size_t output =
                accessor(binary_.end_plain(from), kFloat, times.size(), "VEC3");
            channels.push_back({{"sampler", samplers.size()},
                                {"target", {{"node", nodes[i]}, {"path", "scale"}}}});
            samplers.push_back({{"input", input}, {"output", output}, {"interpolation", "STEP"}});
            if (!first)
                document_["nodes"][nodes[i]]["scale"] = {0, 0, 0};
        }
        document_["animations"] = json::array({{{"name", "steps"},
                                                {"samplers", std::move(samplers)},
                                                {"channels", std::move(channels)}}});
    }

    void finish() {
        binary_.complete();
        const std::uint64_t bytes = binary_.size();
        document_["bufferViews"] = binary_.views();
        document_["buffers"] = binary_.buffers();
        for (const char* list : {"meshes", "materials", "accessors", "bufferViews", "buffers"})
            if (document_[list].empty()) // the specification forbids empty lists
                document_.erase(list);
        if (document_["nodes"][0]["children"].empty())
            document_["nodes"][0].erase("children");
        std::string text = document_.dump(-1, ' ', false, json::error_handler_t::replace);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::uint64_t whole = 12 + 8 + text.size() + (bytes > 0 ? 8 + bytes : 0);
        if (whole > std::numeric_limits<std::uint32_t>::max())
            throw Error("{}: {} bytes, expected fewer than 2^32 in GLB; export fewer steps, or "
                        "each to a file of its own (--format glb)",
                        path_.string(), whole);
        NewFile file(path_);
        BufferedSink out(file);
        const auto put = [&](std::uint64_t number) { out.put(static_cast<std::uint32_t>(number)); };
        put(kMagic);
        put(2);
        put(whole);
        put(text.size());
        put(kJson);
        out.text(text);
        if (bytes > 0) {
            put(bytes);
            put(kBinary);
            binary_.copy_to(out);
        }
        out.flush();
        file.commit();
    }

  private:
    std::size_t push(const char* list, json value) {
        document_[list].push_back(std::move(value));
        return document_[list].size() - 1;
    }
    std::size_t accessor(std::size_t view, int type, std::size_t count, const char* shape) {
        return push(
            "accessors",
            {{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", shape}});
    }

    std::size_t add_places(const ExportedMesh& mesh, const ExportedPlaces& places) {
        glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
        const std::uint64_t begin = binary_.begin();
        mesh.each_vertex([&](const MeshVertex& vertex, float) {
            const glm::vec3 at(places.of(vertex));
            low = glm::min(low, at);
            high = glm::max(high, at);
            binary_.put(at);
        });
        const std::size_t number =
            accessor(binary_.end_vertices(begin, 12), kFloat, mesh.vertices(), "VEC3");
        document_["accessors"][number]["min"] = {low.x, low.y, low.z};
        document_["accessors"][number]["max"] = {high.x, high.y, high.z};
        return number;
    }

    /// Places in 16 bits, the same along all axes so that normals keep their directions.
    /// @param node gets what leads back to the places
    std::size_t add_quantized_places(const ExportedMesh& mesh, const ExportedPlaces& places,
                                     json& node) {
        constexpr double kMost = 65535;
        glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
        mesh.each_vertex([&](const MeshVertex& vertex, float) {
            low = glm::min(low, places.of(vertex));
            high = glm::max(high, places.of(vertex));
        });
        const glm::dvec3 size = high - low;
        const double scale =
            std::max({size.x, size.y, size.z, std::numeric_limits<float>::min() * 1.0});
        node["translation"] = {low.x, low.y, low.z};
        node["scale"] = {scale, scale, scale};
        glm::uvec3 least(65535), most(0);
        const std::uint64_t begin = binary_.begin();
        mesh.each_vertex([&](const MeshVertex& vertex, float) {
            const glm::uvec3 at(glm::round((places.of(vertex) - low) / scale * kMost));
            least = glm::min(least, at);
            most = glm::max(most, at);
            for (int axis = 0; axis < 3; ++axis)
                binary_.put(static_cast<std::uint16_t>(at[axis]));
            binary_.put(std::uint16_t{0}); // a vertex begins at a multiple of four bytes
        });
        const std::size_t number =
            accessor(binary_.end_vertices(begin, 8), kUshort, mesh.vertices(), "VEC3");
        json& made = document_["accessors"][number];
        made["normalized"] = true;
        made["min"] = {least.x, least.y, least.z};
        made["max"] = {most.x, most.y, most.z};
        return number;
    }

    std::size_t add_quantized_normals(const ExportedMesh& mesh) {
        constexpr double kOne = 127;
        const std::uint64_t begin = binary_.begin();
        mesh.each_vertex([&](const MeshVertex& vertex, float) {
            glm::dvec3 normal = normal_of(vertex);
            if (normal == glm::dvec3(0.0))
                normal = {0, 0, 1};
            for (int axis = 0; axis < 3; ++axis)
                binary_.put(static_cast<std::int8_t>(std::lround(normal[axis] * kOne)));
            binary_.put(std::int8_t{0});
        });
        const std::size_t number =
            accessor(binary_.end_vertices(begin, 4), kByte, mesh.vertices(), "VEC3");
        document_["accessors"][number]["normalized"] = true;
        return number;
    }

    std::size_t add_normals(const ExportedMesh& mesh) {
        const std::uint64_t begin = binary_.begin();
        mesh.each_vertex([&](const MeshVertex& vertex, float) {
            const glm::vec3 normal(normal_of(vertex)); // a glTF normal has length 1
            binary_.put(normal == glm::vec3(0.0f) ? glm::vec3(0.0f, 0.0f, 1.0f) : normal);
        });
        return accessor(binary_.end_vertices(begin, 12), kFloat, mesh.vertices(), "VEC3");
    }

    std::size_t add_colors(const ExportedSurface& surface) {
        const std::uint64_t begin = binary_.begin();
        constexpr float kFull = 255;
        surface.mesh->each_vertex([&](const MeshVertex&, float value) {
            for (const std::uint8_t channel : surface.color_at(value))
                binary_.put(static_cast<std::uint8_t>(std::lround(kFull * linear_light(channel))));
            binary_.put(std::uint8_t{255});
        });
        const std::size_t number =
            accessor(binary_.end_vertices(begin, 4), kUbyte, surface.mesh->vertices(), "VEC4");
        document_["accessors"][number]["normalized"] = true;
        return number;
    }

    std::size_t add_material(const ExportedSurface& surface) {
        const auto& c = surface.color;
        json factor = !surface.color_of
                          ? json{linear_light(c[0]), linear_light(c[1]), linear_light(c[2])}
                          : json{1, 1, 1};
        factor.push_back(surface.opacity);
        json material{
            {"name", surface.name},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", factor}, {"metallicFactor", 0}, {"roughnessFactor", 0.6}}},
            {"doubleSided", true}};
        if (surface.opacity < 1)
            material["alphaMode"] = "BLEND";
        auto& all = document_["materials"];
        const auto found = std::ranges::find(all, material);
        if (found != all.end())
            return static_cast<std::size_t>(found - all.begin());
        return push("materials", std::move(material));
    }

    std::size_t add(const ExportedSurface& surface, std::size_t place,
                    const ExportedPlaces& places) {
        const ExportedMesh& mesh = *surface.mesh;
        json node{{"name", surface.name},
                  {"extras", {{"surface", place}, {"isovalue", surface.isovalue}}}};
        json attributes;
        attributes["POSITION"] =
            plan_.quantized ? add_quantized_places(mesh, places, node) : add_places(mesh, places);
        if (plan_.normals)
            attributes["NORMAL"] =
                plan_.quantized ? add_quantized_normals(mesh) : add_normals(mesh);
        if (surface.color_of)
            attributes["COLOR_0"] = add_colors(surface);
        const std::uint64_t begin = binary_.begin();
        mesh.each_triangle([&](const auto& corners) {
            for (const std::uint32_t corner : places.triangle(corners))
                binary_.put(corner);
        });
        const std::size_t indices = accessor(binary_.end_triangles(begin, mesh.vertices()), kUint,
                                             3 * mesh.triangles(), "SCALAR");
        const std::size_t material = add_material(surface);
        const std::size_t number =
            push("meshes", {{"name", surface.name},
                            {"primitives", json::array({{{"attributes", attributes},
                                                         {"indices", indices},
                                                         {"material", material}}})}});
        node["mesh"] = number;
        return push("nodes", std::move(node));
    }

    const ExportPlan& plan_;
    std::filesystem::path path_;
    GlbViews binary_;
    json document_;
};

class GlbWriter : public SurfaceWriter {
  public:
    GlbWriter(const ExportPlan& plan, std::filesystem::path name)
        : plan_(plan), name_(std::move(name)) {}
    void add(const ExportedStep& step) override {
        GlbFile file(plan_, file_of_step(name_, plan_, step.instant.step));
        file.add(step);
        file.finish();
    }

  private:
    ExportPlan plan_;
    std::filesystem::path name_;
};

class GlbAnimationWriter : public SurfaceWriter {
  public:
    GlbAnimationWriter(const ExportPlan& plan, const std::filesystem::path& name)
        : plan_(plan), file_(plan_, name) {}
    void add(const ExportedStep& step) override { nodes_.push_back(file_.add(step)); }
    void finish() override {
        if (nodes_.size() > 1)
            file_.animate(nodes_);
        file_.finish();
    }

  private:
    ExportPlan plan_;
    GlbFile file_;
    std::vector<std::size_t> nodes_;
};

} // namespace

std::unique_ptr<SurfaceWriter> glb_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name) {
    return std::make_unique<GlbWriter>(plan, name);
}

std::unique_ptr<SurfaceWriter> glb_animation_writer(const ExportPlan& plan,
                                                    const std::filesystem::path& name) {
    return std::make_unique<GlbAnimationWriter>(plan, name);
}

} // namespace isochron::index
