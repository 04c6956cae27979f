// Asks readers for models, and trusts nothing that they answer.
#include "index/readers/formats/model_file.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/name_pattern.h"
#include "index/readers/formats/length_units.h"
#include "index/readers/formats/reader_lease.h"
#include "index/readers/formats/series/numbered_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

namespace isochron::index {
namespace {

struct ModelFormat {
    std::string_view extension, reader;
    bool in_meters = false;
};
constexpr std::array kModelFormats{ModelFormat{".stl", "isochron-reader-model"},
                                   ModelFormat{".ply", "isochron-reader-model"},
                                   ModelFormat{".obj", "isochron-reader-model"},
                                   ModelFormat{".vtp", "isochron-reader-mesh"},
                                   ModelFormat{".gltf", "isochron-reader-mesh", true},
                                   ModelFormat{".glb", "isochron-reader-mesh", true}};

const ModelFormat* model_format(const std::filesystem::path& path) {
    const auto* const found = std::ranges::find(
        kModelFormats, lower_case(path.extension().string()), &ModelFormat::extension);
    return found == kModelFormats.end() ? nullptr : found;
}

template <class T>
void take_part(std::span<const std::byte>& from, std::vector<T>& part) {
    std::memcpy(part.data(), from.data(), part.size() * sizeof(T));
    from = from.subspan(part.size() * sizeof(T));
}

bool is_whole(const TriangleMesh& mesh) {
    const auto finite = [](const glm::vec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    return std::ranges::all_of(mesh.points, finite) && std::ranges::all_of(mesh.normals, finite) &&
           std::ranges::all_of(mesh.corners,
                               [&](std::uint32_t corner) { return corner < mesh.points.size(); });
}

/// `hull_%04d.stl` as `hull_*.stl`.
std::string pattern_of(std::string name) {
    const std::size_t begin = name.find('%');
    const std::size_t end =
        begin == std::string::npos ? begin : name.find_first_not_of("0123456789", begin + 1);
    if (end != std::string::npos && name[end] == 'd')
        name.replace(begin, end + 1 - begin, "*");
    return name;
}

} // namespace

bool is_model_name(const std::filesystem::path& path) {
    return model_format(path) != nullptr;
}

std::string model_extensions() {
    std::string all;
    for (const ModelFormat& format : kModelFormats)
        all += fmt::format("{}{}", all.empty() ? "" : ", ", format.extension);
    return all;
}

bool is_model_series(const std::filesystem::path& path) {
    return pattern_of(path.filename().string()).find('*') != std::string::npos;
}

std::filesystem::path file_of_model_series(const std::filesystem::path& path, std::size_t step,
                                           std::size_t steps) {
    const std::string pattern = pattern_of(path.filename().string());
    std::vector<NumberedName> names;
    std::error_code error;
    for (std::filesystem::directory_iterator file(path.parent_path(), error), end;
         !error && file != end; file.increment(error))
        if (const std::string name = file->path().filename().string();
            matches_pattern(pattern, name) && is_model_name(name))
            names.push_back(taken_apart(name));
    if (names.size() != steps)
        throw Error("{}: {} files, expected {}: one for each step", path.string(), names.size(),
                    steps);
    const auto found = names.begin() + static_cast<std::ptrdiff_t>(std::min(step, steps - 1));
    std::nth_element(names.begin(), found, names.end(), natural_less);
    const std::filesystem::path file = path.parent_path() / found->name;
    if (std::filesystem::is_symlink(file, error))
        throw Error("{}: is a link, expected the files of a series", file.string());
    return file;
}

TriangleMesh read_model(const std::filesystem::path& path, const std::string& unit,
                        const std::stop_token& stop) {
    const ModelFormat* const format = model_format(path);
    if (!format)
        throw Error("{}: no model by its name: expected {}", path.string(), model_extensions());
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        throw Error("{}: {}", path.string(),
                    std::filesystem::exists(path, error) ? "is no file, expected a model"
                                                         : "there is no such file");
    ReaderPool& readers = readers_of_this_process();
    readers.let_read(path);
    ReaderLease lease(readers, std::string(format->reader), path, false);
    TriangleMesh mesh;
    lease.work([] {},
               [&] {
                   lease.reader().ask(ReadModel{path});
                   const auto read = lease.expect<ModelRead>(stop);
                   const std::uint64_t most = std::uint64_t{3} * kMostModelTriangles;
                   if (read.points == 0 || read.points > most || read.corners == 0 ||
                       read.corners > most || read.corners % 3 != 0 ||
                       !std::isfinite(read.origin.x + read.origin.y + read.origin.z))
                       throw Error("{}: its reader describes no model", path.string());
                   mesh.origin = read.origin;
                   mesh.points.resize(read.points);
                   mesh.normals.resize(read.points);
                   mesh.corners.resize(read.corners);
                   std::span<const std::byte> shared = lease.reader().memory(
                       read.points * 2 * sizeof(glm::vec3) + read.corners * sizeof(std::uint32_t));
                   lease.reader().ask(TakeModel{});
                   lease.expect<SlabRead>(stop);
                   take_part(shared, mesh.points);
                   take_part(shared, mesh.normals);
                   take_part(shared, mesh.corners);
                   if (!is_whole(mesh))
                       throw Error("{}: its reader describes no model", path.string());
               });
    if (const auto meters = meters_in(unit); meters && format->in_meters) {
        mesh.origin /= *meters;
        for (glm::vec3& point : mesh.points)
            point = glm::vec3(glm::dvec3(point) / *meters);
    }
    return mesh;
}

} // namespace isochron::index
