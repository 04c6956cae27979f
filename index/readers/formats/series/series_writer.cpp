// Writes .pvd and .vti without VTK, so that making data does not need it.
#include "index/readers/formats/series/series_writer.h"

#include "index/error.h"
#include "index/system/new_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

constexpr std::size_t kBlockBytes = 1 << 16;
constexpr int kCompressionLevel = 1; // a higher level gains little for volumes of floats

std::string_view vtk_name_of(ValueType type) {
    switch (type) {
    case ValueType::i8: return "Int8";
    case ValueType::u8: return "UInt8";
    case ValueType::i16: return "Int16";
    case ValueType::u16: return "UInt16";
    case ValueType::i32: return "Int32";
    case ValueType::f32: return "Float32";
    case ValueType::f64: break;
    }
    return "Float64";
}

std::string escaped(std::string_view text) {
    std::string out;
    for (char c : text) {
        switch (c) {
        case '&': out += "&amp;"; break;
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '"': out += "&quot;"; break;
        default: out += c;
        }
    }
    return out;
}

void write_whole(const fs::path& path, std::string_view bytes) {
    write_file(path, std::as_bytes(std::span(bytes)));
}

void append_number(std::string& out, std::uint64_t number) {
    char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    out.append(bytes, sizeof number);
}

// VTK's block layout: block count, block size, size of the partial last block or 0, then every
// block's compressed size, then the blocks.
std::string compressed(std::span<const std::byte> values) {
    const std::size_t blocks = (values.size() + kBlockBytes - 1) / kBlockBytes;
    std::string sizes, body;
    std::string block(compressBound(kBlockBytes), '\0');
    for (std::size_t i = 0; i < blocks; ++i) {
        const auto part =
            values.subspan(i * kBlockBytes, std::min(kBlockBytes, values.size() - i * kBlockBytes));
        uLongf size = block.size();
        if (compress2(reinterpret_cast<Bytef*>(block.data()), &size,
                      reinterpret_cast<const Bytef*>(part.data()), part.size(),
                      kCompressionLevel) != Z_OK)
            throw Error("zlib: cannot compress a step: out of memory");
        append_number(sizes, size);
        body.append(block, 0, size);
    }
    std::string out;
    append_number(out, blocks);
    append_number(out, kBlockBytes);
    append_number(out, values.size() % kBlockBytes);
    return out + sizes + body;
}

} // namespace

SeriesWriter::SeriesWriter(fs::path dir, std::string name, SeriesInfo info)
    : dir_(std::move(dir)), name_(std::move(name)), info_(std::move(info)) {
    if (info_.scaling != Scaling{})
        throw Error("{}: a .vti carries no scaling, slope {} and intercept {} given", name_,
                    info_.scaling.slope, info_.scaling.intercept);
    make_folder(dir_);
    temporary_.emplace(dir_ / name_, name_);
}

SeriesWriter::~SeriesWriter() = default;

std::string SeriesWriter::file_of(const std::string& name, std::size_t step) {
    return fmt::format("{}_{:04}.vti", name, step);
}

void SeriesWriter::append(std::span<const std::byte> values, double time) {
    if (values.size() != info_.step_bytes())
        throw Error("{}: step {} has {} bytes, expected {}", name_, steps_.size(), values.size(),
                    info_.step_bytes());
    if (!std::isfinite(time) || (!steps_.empty() && time <= steps_.back().time))
        throw Error("{}: step {} is at time {}, expected a greater one than before", name_,
                    steps_.size(), time);
    steps_.push_back({file_of(name_, steps_.size()), time});
    write_whole(temporary(steps_.back().file), vti(values, time));
}

void SeriesWriter::finish() {
    std::string pvd = "<?xml version=\"1.0\"?>\n"
                      "<VTKFile type=\"Collection\" version=\"1.0\" "
                      "byte_order=\"LittleEndian\">\n  <Collection>\n";
    for (const Step& step : steps_)
        pvd += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                           step.time, escaped(step.file));
    pvd += "  </Collection>\n</VTKFile>\n";
    write_whole(temporary(name_ + ".pvd"), pvd);
    for (const Step& step : steps_)
        publish(step.file);
    publish(name_ + ".pvd");
}

void SeriesWriter::publish(const std::string& file) const {
    std::error_code failure;
    fs::rename(temporary(file), dir_ / file, failure);
    if (failure)
        throw Error("{}: cannot be written: {}", (dir_ / file).string(), failure.message());
}

std::string SeriesWriter::vti(std::span<const std::byte> values, double time) const {
    const Grid& grid = info_.grid;
    const auto c = grid.cells();
    const std::string extent = fmt::format("0 {} 0 {} 0 {}", c[0], c[1], c[2]);
    const glm::dmat3& d = grid.direction;
    return fmt::format("<?xml version=\"1.0\"?>\n"
                       "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
                       "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
                       "  <ImageData WholeExtent=\"{0}\" Origin=\"{1} {2} {3}\" "
                       "Spacing=\"{4} {5} {6}\" Direction=\"{7} {8} {9} {10} {11} {12} {13} {14} "
                       "{15}\">\n",
                       extent, grid.origin.x, grid.origin.y, grid.origin.z, grid.spacing.x,
                       grid.spacing.y, grid.spacing.z, d[0][0], d[1][0], d[2][0], d[0][1], d[1][1],
                       d[2][1], d[0][2], d[1][2], d[2][2]) +
           fmt::format("    <FieldData>\n"
                       "      <DataArray type=\"Float64\" Name=\"TimeValue\" "
                       "NumberOfTuples=\"1\" format=\"ascii\">{0}</DataArray>\n"
                       "    </FieldData>\n"
                       "    <Piece Extent=\"{1}\">\n"
                       "      <PointData Scalars=\"{2}\">\n"
                       "        <DataArray type=\"{3}\" Name=\"{2}\" format=\"appended\" "
                       "offset=\"0\"/>\n"
                       "      </PointData>\n"
                       "    </Piece>\n"
                       "  </ImageData>\n"
                       "  <AppendedData encoding=\"raw\">\n_",
                       time, extent, escaped(info_.array), vtk_name_of(info_.type)) +
           compressed(values) + "\n  </AppendedData>\n</VTKFile>\n";
}

} // namespace isochron::index
