// Reads and writes kept curves.
#include "app/kept/kept_curves.h"

#include "index/error.h"
#include "index/file/sections/file_layout.h"
#include "index/measure/measures.h"
#include "index/system/kept_files.h"
#include "index/system/new_file.h"
#include "version_number.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExtension = ".curve";
constexpr std::string_view kBegin = "isochron curve 1\n";

std::string text_of(const glm::dvec3& at) {
    return fmt::format("{:a} {:a} {:a}", at.x, at.y, at.z);
}

/// Says what a curve is of: equal for equal numbers. All doubles are written exactly.
std::string key_of(const CurveSubject& subject) {
    const index::IndexFile& file = *subject.array;
    std::string key = fmt::format("{};{:016x};{}:{};{};{};", ISOCHRON_VERSION, file.content_hash(),
                                  file.info().array.size(), file.info().array,
                                  file.metadata().reading_number, file.info().steps());
    if (subject.place)
        return key + "value at " + text_of(*subject.place);
    key += fmt::format("{:a}", subject.isovalue);
    if (subject.clip)
        key += ";clip " + text_of(subject.clip->point) + ' ' + text_of(subject.clip->normal);
    if (subject.box)
        key += fmt::format(";box {} to {}", fmt::join(subject.box->first, " "),
                           fmt::join(subject.box->last, " "));
    for (const auto& [name, places] :
         {std::pair("only", &subject.kept.only), std::pair("without", &subject.kept.hidden)})
        for (const index::PieceAt& each : *places)
            key += fmt::format(";{} {}", name, text_of(each.place));
    if (subject.kept.dust > 0)
        key += fmt::format(";dust {}", subject.kept.dust);
    if (subject.on_surface) {
        const index::ColorSource other(file, *subject.on_surface);
        key += fmt::format(";on {}", other.array().array);
    }
    if (subject.from)
        key += ";from " + text_of(*subject.from);
    for (const index::Measure& each : index::measures())
        key += fmt::format(";{}: {}", each.name, each.definition);
    return key;
}

std::uint64_t hash_of(std::string_view text) {
    return index::checksum_of(std::as_bytes(std::span(text)));
}

/// A checksum, what the curve is of, and the numbers: of each measure those of all steps.
std::string bytes_of(const std::string& key, const std::vector<std::vector<double>>& values) {
    std::string payload = key + '\0';
    for (const std::vector<double>& each : values)
        payload.append(reinterpret_cast<const char*>(each.data()), each.size() * sizeof(double));
    const std::uint64_t checksum = hash_of(payload);
    std::string bytes(kBegin);
    bytes.append(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
    return bytes + payload;
}

} // namespace

KeptCurves::KeptCurves(fs::path folder, std::size_t most_files, std::uint64_t most_bytes)
    : folder_(std::move(folder)), most_files_(most_files), most_bytes_(most_bytes) {}

fs::path KeptCurves::path_of(const CurveSubject& subject) const {
    return folder_ / fmt::format("{:016x}{}", hash_of(key_of(subject)), kExtension);
}

std::optional<StepCurve> KeptCurves::read(const CurveSubject& subject) const {
    StepCurve curve(subject, numbers_of(subject), subject.array->info().steps());
    const std::string key = key_of(subject);
    const std::size_t expected = bytes_of(key, curve.values).size();
    const fs::path path = path_of(subject);
    std::error_code error;
    if (!fs::is_regular_file(path, error) || fs::file_size(path, error) != expected || error)
        return std::nullopt;
    std::ifstream in(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    if (bytes.size() != expected)
        return std::nullopt;
    const char* from = bytes.data() + kBegin.size() + sizeof(std::uint64_t) + key.size() + 1;
    for (std::vector<double>& each : curve.values) {
        std::memcpy(each.data(), from, each.size() * sizeof(double));
        from += each.size() * sizeof(double);
    }
    if (bytes_of(key, curve.values) != bytes) // which compares the checksum, too
        return std::nullopt;
    std::ranges::fill(curve.known, std::uint8_t{1});
    curve.left = 0;
    fs::last_write_time(path, fs::file_time_type::clock::now(), error); // when it was used
    return curve;
}

void KeptCurves::write(const StepCurve& curve) const {
    const std::string bytes = bytes_of(key_of(curve.subject), curve.values);
    if (bytes.size() > most_bytes_)
        return;
    try {
        index::make_folder(folder_);
        const fs::path path = path_of(curve.subject);
        index::write_file(path, std::as_bytes(std::span(bytes)));
        index::make_room(folder_, kExtension, path, {most_bytes_, most_files_});
    } catch (const index::Error&) { // it is made anew the next time
    }
}

} // namespace isochron::app
