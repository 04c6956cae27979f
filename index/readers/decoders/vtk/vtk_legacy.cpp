// Reads legacy VTK structured points (.vtk), ascii and binary, with vtkStructuredPointsReader.
#include "index/error.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/vtk/vtk_fields.h"
#include "index/readers/decoders/vtk/vtk_ghosts.h"
#include "index/readers/decoders/vtk/vtk_legacy_reading.h"
#include "index/readers/decoders/vtk/vtk_session.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/stored_file.h"

#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>

#include <algorithm>
#include <iterator>
#include <sstream>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

// Checks that the file is large enough: VTK allocates memory by DIMENSIONS and the first array's
// components before it looks for values. A value takes at least a byte.
void expect_believable(const fs::path& path) {
    const std::string name = path.string();
    constexpr std::size_t kHead = 4096;
    std::istringstream head(head_of(path, kHead));
    std::string word;
    std::getline(head, word);
    if (!word.starts_with("# vtk DataFile"))
        throw Error("{}: not a legacy VTK file", name);
    std::getline(head, word); // the title may hold any word
    std::array<std::int64_t, 3> sizes{};
    std::uint64_t components = 1;
    while (head >> word) {
        if (word == "DATASET" && head >> word && word != "STRUCTURED_POINTS")
            throw Error("{}: holds {}, expected STRUCTURED_POINTS", name, word);
        if (word == "DIMENSIONS")
            head >> sizes[0] >> sizes[1] >> sizes[2];
        if (word == "SCALARS") {
            std::string line; // name, type and, if not 1, the number of components
            std::getline(head, line);
            std::istringstream(line) >> word >> word >> components;
            break;
        }
    }
    if (sizes == std::array<std::int64_t, 3>{})
        throw Error("{}: gives no DIMENSIONS", name);
    Grid grid;
    grid.vertices = checked_vertices(sizes, name);
    components = std::max<std::uint64_t>(components, 1);
    if (grid.cell_count() > file_bytes(path) / components)
        throw Error("{}: truncated: {} vertices of {} components in {} bytes", name,
                    grid.vertex_count(), components, file_bytes(path));
}

class LegacyFile final : public DecodedFile {
  public:
    LegacyFile(fs::path path, const ReadOptions& options) : path_(std::move(path)) {
        expect_believable(path_);
        with_vtk(path_, [&] {
            read_all(*reader_, path_);
            vtkImageData& image = *reader_->GetOutput();
            info_.grid = grid_of_vtk(*reinterpret_cast<int(*)[6]>(image.GetExtent()),
                                     image.GetOrigin(), image.GetSpacing(),
                                     image.GetDirectionMatrix()->GetData(), path_.string());
            chosen_ = choose_scalar(without_flags(arrays_of_vtk(image)), options, path_.string());
            hidden_ = hidden_by_flags(flags_of_vtk(image, info_.grid), chosen_, info_.grid);
            chosen_.describe(info_);
            info_.notes = chosen_.notes();
            std::ranges::copy(notes_on_hidden(hidden_, chosen_.array.on_cells),
                              std::back_inserter(info_.notes));
            take_time_of_vtk(image.GetFieldData(), info_);
            take_fields_of_vtk(image, chosen_, info_);
        });
    }

    std::size_t steps() const override { return 1; }

    std::uint32_t slices_at_once() const override { return slices_of_vtk(chosen_, info_); }
    std::uint64_t decoded_bytes() const override { return bytes_of_vtk(chosen_, info_.grid); }

    void read(std::size_t, Slices slices, std::span<std::byte> out) override {
        values_of_vtk(*reader_->GetOutput(), chosen_, info_.grid, slices, hidden_, out,
                      path_.string());
    }

  private:
    fs::path path_;
    ChosenScalar chosen_;
    std::vector<std::uint8_t> hidden_;
    vtkNew<vtkStructuredPointsReader> reader_;
};

} // namespace

std::unique_ptr<DecodedFile> decode_vtk(const fs::path& path, const ReadOptions& options) {
    const std::string head = head_of(path, 4096);
    // The third line of the header, behind a title that may hold any word.
    for (const char* other :
         {"\nDATASET RECTILINEAR_GRID", "\nDATASET STRUCTURED_GRID", "\nDATASET UNSTRUCTURED_GRID"})
        if (head.starts_with("# vtk DataFile") && head.find(other) != std::string::npos)
            return decode_vtk_data(path, options);
    return std::make_unique<LegacyFile>(path, options);
}

} // namespace isochron::index
