// What else VTK reads: rectilinear grids, files of several pieces, and grids of any kind that are
// resampled (vtkXMLGenericDataObjectReader, vtkDataSetReader).
#include "index/error.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/shared_decode.h"
#include "index/readers/decoders/vtk/vtk_fields.h"
#include "index/readers/decoders/vtk/vtk_ghosts.h"
#include "index/readers/decoders/vtk/vtk_legacy_reading.h"
#include "index/readers/decoders/vtk/vtk_resample.h"
#include "index/readers/decoders/vtk/vtk_session.h"
#include "index/readers/decoders/vtk/xml_markup.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/stated/array_places.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"

#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetReader.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkRectilinearGrid.h>
#include <vtkXMLGenericDataObjectReader.h>
#include <vtkXMLReader.h>
#include <vtkXMLUniformGridAMRReader.h>

#include <algorithm>
#include <iterator>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

vtkSmartPointer<vtkDataObject> read_xml(const fs::path& path) {
    const std::string name = path.string();
    const MappedFile file(path);
    const std::string_view markup = markup_of(file);
    if (markup.find("<VTKFile") == markup.npos)
        throw Error("{}: not VTK XML", name);
    expect_end(file, name);
    expect_shallow(markup, name);
    expect_names(markup, name);
    const vtkNew<vtkXMLGenericDataObjectReader> any;
    bool parallel = false;
    const int type = any->ReadOutputType(path.c_str(), parallel);
    const auto reader = type < 0 ? nullptr : any->CreateReader(type, parallel);
    if (!reader)
        throw Error("{}: holds no data that VTK knows", name);
    // Else it reads the coarsest level alone.
    if (auto* levels = vtkXMLUniformGridAMRReader::SafeDownCast(reader))
        levels->SetMaximumLevelsToReadByDefault(0);
    reader->SetFileName(path.c_str());
    if (const auto text = with_slashes(markup, path)) {
        reader->ReadFromInputStringOn();
        const auto appended = file.bytes().subspan(markup.size());
        reader->SetInputString(
            *text + std::string(reinterpret_cast<const char*>(appended.data()), appended.size()));
    }
    reader->Update();
    return reader->GetOutputDataObject(0);
}

vtkSmartPointer<vtkDataObject> read_legacy(const fs::path& path) {
    const vtkNew<vtkDataSetReader> reader;
    read_all(*reader, path);
    return reader->GetOutput();
}

std::vector<double> coordinates_of(vtkDataArray* array) {
    std::vector<double> at;
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
        at.push_back(array->GetTuple1(i));
    return at;
}

/// All that a file holds, and its place.
class VtkData {
  public:
    VtkData(fs::path path, const ReadOptions& options) : path_(std::move(path)) {
        file_bytes(path_);
        with_vtk(path_, [&] {
            const bool legacy = head_of(path_, 16).starts_with("# vtk DataFile");
            read_ = legacy ? read_legacy(path_) : read_xml(path_);
            if (!read_)
                throw Error("{}: holds no data that VTK knows", path_.string());
            place(*read_, options);
        });
    }

    vtkDataObject& read() const { return *read_; } ///< as it was read
    vtkDataSet& data() const { return *data_; }    ///< on the grid
    bool resampled() const { return resampled_; }
    const Grid& grid() const { return info_.grid; }
    const std::vector<std::string>& notes() const { return info_.notes; } ///< on the grid

  private:
    void place(vtkDataObject& read, const ReadOptions& options) {
        vtkSmartPointer<vtkImageData> image = vtkImageData::SafeDownCast(&read);
        auto* rectilinear = vtkRectilinearGrid::SafeDownCast(&read);
        if (!image && !rectilinear && !options.resample)
            throw Error(
                "{}: holds {}, expected image data or a rectilinear grid; --resample NX NY NZ "
                "makes a regular grid of it, --resample-by-cell one as fine as its smallest cell",
                path_.string(), read.GetClassName());
        if (!image && !rectilinear) {
            image = onto_image(read, *options.resample, path_.string());
            resampled_ = true;
        }
        if (image) {
            data_ = image;
            info_.grid = grid_of_vtk(*reinterpret_cast<int(*)[6]>(image->GetExtent()),
                                     image->GetOrigin(), image->GetSpacing(),
                                     image->GetDirectionMatrix()->GetData(), path_.string());
            return;
        }
        data_ = rectilinear;
        place_rectilinear(*rectilinear, options);
    }

    void place_rectilinear(vtkRectilinearGrid& grid, const ReadOptions& options) {
        const std::string name = path_.string();
        const std::array<std::vector<double>, 3> at{coordinates_of(grid.GetXCoordinates()),
                                                    coordinates_of(grid.GetYCoordinates()),
                                                    coordinates_of(grid.GetZCoordinates())};
        const int* sizes = grid.GetDimensions();
        info_.grid.vertices = checked_vertices({sizes[0], sizes[1], sizes[2]}, name);
        StatedArray stated{.file = name, .name = {}, .axes = std::vector<StatedAxis>(3)}; // z, y, x
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (at[axis].size() != info_.grid.vertices[axis])
                throw Error("{}: {} coordinates along {}, expected {}", name, at[axis].size(),
                            "xyz"[axis], info_.grid.vertices[axis]);
            stated.axes[2 - axis].at = at[axis];
        }
        place_axes(stated, layout_of_zyx(), options, info_);
    }

    fs::path path_;
    SeriesInfo info_; ///< grid and notes
    vtkSmartPointer<vtkDataObject> read_;
    vtkSmartPointer<vtkDataSet> data_;
    bool resampled_ = false;
};

class VtkDataFile final : public DecodedFile {
  public:
    VtkDataFile(fs::path path, const ReadOptions& options) : path_(std::move(path)) {
        static SharedDecode<VtkData> open;
        all_ = open.of(path_, options, [&] { return std::make_shared<VtkData>(path_, options); });
        with_vtk(path_, [&] {
            vtkDataSet& data = all_->data();
            info_.grid = all_->grid();
            info_.notes = all_->notes();
            chosen_ = choose_scalar(without_flags(arrays_of_vtk(data)), options, path_.string());
            hidden_ = hidden_by_flags(flags_of_vtk(data, info_.grid), chosen_, info_.grid);
            chosen_.describe(info_);
            if (all_->resampled())
                info_.notes.push_back(note_on_resampling(
                    all_->read(), *vtkImageData::SafeDownCast(&data), chosen_, hidden_));
            std::ranges::copy(chosen_.notes(), std::back_inserter(info_.notes));
            std::ranges::copy(notes_on_hidden(hidden_, chosen_.array.on_cells, all_->resampled()),
                              std::back_inserter(info_.notes));
            take_time_of_vtk(all_->read().GetFieldData(), info_);
            take_fields_of_vtk(all_->read(), chosen_, info_);
        });
    }

    std::size_t steps() const override { return 1; }
    std::uint32_t slices_at_once() const override { return slices_of_vtk(chosen_, info_); }
    std::uint64_t decoded_bytes() const override { return bytes_of_vtk(chosen_, info_.grid); }

    void read(std::size_t, Slices slices, std::span<std::byte> out) override {
        values_of_vtk(all_->data(), chosen_, info_.grid, slices, hidden_, out, path_.string());
    }

  private:
    fs::path path_;
    std::shared_ptr<VtkData> all_; ///< shared with the file's other arrays
    ChosenScalar chosen_;
    std::vector<std::uint8_t> hidden_;
};

} // namespace

std::unique_ptr<DecodedFile> decode_vtk_data(const fs::path& path, const ReadOptions& options) {
    return std::make_unique<VtkDataFile>(path, options);
}

} // namespace isochron::index
