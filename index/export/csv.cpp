// CSV (RFC 4180) of the active cells: a line for each, with its id, the place of its middle, and its
// normal. Columns keep their places: new ones come last.
#include "index/export/buffered_sink.h"
#include "index/export/surface_writer.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>

namespace isochron::index {
namespace {

/// Text that neither ends its cell nor is taken for a formula by a spreadsheet.
std::string cell_of(const std::string& text) {
    constexpr std::string_view kFormulas = "=+-@\t\r";
    std::string cell = "\"";
    if (!text.empty() && kFormulas.find(text.front()) != std::string_view::npos)
        cell += '\'';
    for (const char c : text)
        cell.append(c == '"' ? 2 : 1, c);
    return text.find_first_of("\",\r\n") == std::string::npos ? cell.substr(1) : cell + '"';
}

class CsvWriter : public SurfaceWriter {
  public:
    CsvWriter(const ExportPlan& plan, std::filesystem::path name)
        : plan_(plan), name_(std::move(name)) {}

    void add(const ExportedStep& step) override {
        NewFile file(file_of_step(name_, plan_, step.instant.step));
        BufferedSink out(file);
        out.text("surface,isovalue,id,x,y,z,nx,ny,nz,number,time,time_unit,length_unit\n");
        const std::string when = fmt::format("{},{},{}", step.time, cell_of(plan_.time_unit),
                                             cell_of(plan_.length_unit));
        fmt::memory_buffer line;
        for (std::size_t number = 0; number < step.surfaces.size(); ++number)
            for (const CellPoint& cell : step.surfaces[number].cells->points) {
                constexpr double kMiddle = 0.5;
                const glm::dvec3 at =
                    step.grid->physical(glm::dvec3(cell.x, cell.y, cell.z) + kMiddle) *
                    plan_.unit_factor;
                const glm::dvec3 normal = unpack_plane(cell.plane).normal;
                line.clear();
                fmt::format_to(std::back_inserter(line),
                               "{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{},{}\n", number + 1,
                               step.surfaces[number].isovalue,
                               wide_id(*step.grid, cell.x, cell.y, cell.z), at.x, at.y, at.z,
                               normal.x, normal.y, normal.z, number, when);
                out.text({line.data(), line.size()});
            }
        out.flush();
        file.commit();
    }

  private:
    ExportPlan plan_;
    std::filesystem::path name_;
};

} // namespace

std::unique_ptr<SurfaceWriter> csv_writer(const ExportPlan& plan,
                                          const std::filesystem::path& name) {
    return std::make_unique<CsvWriter>(plan, name);
}

} // namespace isochron::index
