// Grids of simulations that VTK has readers for, resampled: Exodus, CGNS, OpenFOAM, AMReX.
#include "index/error.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/mesh/mesh_source.h"
#include "index/readers/decoders/shared_decode.h"
#include "index/readers/decoders/vtk/vtk_fields.h"
#include "index/readers/decoders/vtk/vtk_ghosts.h"
#include "index/readers/decoders/vtk/vtk_resample.h"
#include "index/readers/decoders/vtk/vtk_session.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/unread_fields.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// The times in a file, in order; empty where it gives none.
std::vector<double> times_of(vtkAlgorithm& reader, const std::string& file) {
    vtkInformation* out = reader.GetOutputInformation(0);
    vtkInformationDoubleVectorKey* key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
    if (!out || !out->Has(key))
        return {};
    const double* first = out->Get(key);
    std::vector<double> times(first, first + out->Length(key));
    if (std::ranges::adjacent_find(times, std::greater_equal<>()) != times.end())
        throw Error("{}: its times do not increase", file);
    return times;
}

/// An open mesh: all arrays of one step, on the regular grid.
class Mesh {
  public:
    Mesh(fs::path path, const std::array<std::uint32_t, 3>& vertices) : path_(std::move(path)) {
        const std::string name = path_.string();
        with_vtk(path_, [&] {
            source_ = open_mesh_source(path_);
            source_.reader->UpdateInformation();
        });
        with_vtk(path_, [&] {
            source_.select_all();
            times_ = times_of(*source_.reader, name);
        });
        with_vtk(path_, [&] { image_ = onto_image(load(0), vertices, name); });
    }

    const MeshSource& source() const { return source_; }
    const std::vector<double>& times() const { return times_; } ///< empty if it gives none

    /// Call both within `with_vtk`. The image of a step is there until another is asked for.
    vtkImageData& image(std::size_t step) {
        if (step != held_) {
            image_ = onto_image_like(load(step), *image_, path_.string());
            held_ = step;
        }
        return *image_;
    }
    /// What the image is made of.
    vtkDataObject& data() { return *source_.reader->GetOutputDataObject(0); }

  private:
    vtkDataObject& load(std::size_t step) {
        if (times_.empty())
            source_.reader->Update();
        else
            source_.reader->UpdateTimeStep(times_[step]);
        if (!source_.reader->GetOutputDataObject(0))
            throw Error("{}: holds no mesh that VTK knows", path_.string());
        return data();
    }

    fs::path path_;
    MeshSource source_;
    std::vector<double> times_;
    vtkSmartPointer<vtkImageData> image_; ///< image of the step `held_`
    std::size_t held_ = 0;
};

class MeshFile final : public DecodedFile {
  public:
    MeshFile(fs::path path, const ReadOptions& options) : path_(std::move(path)) {
        if (!options.resample)
            throw Error("{}: a mesh, expected a regular grid; --resample NX NY NZ or "
                        "--resample-by-cell makes one of it",
                        path_.string());
        static SharedDecode<Mesh> open;
        mesh_ = open.of(path_, options,
                        [&] { return std::make_shared<Mesh>(path_, *options.resample); });
        with_vtk(path_, [&] { describe(options); });
    }

    std::size_t steps() const override { return std::max<std::size_t>(mesh_->times().size(), 1); }
    std::uint32_t slices_at_once() const override { return slices_of_vtk(chosen_, info_); }
    std::uint64_t decoded_bytes() const override { return bytes_of_vtk(chosen_, info_.grid); }

    void read(std::size_t step, Slices slices, std::span<std::byte> out) override {
        with_vtk(path_, [&] {
            vtkImageData& image = mesh_->image(step);
            if (step != hidden_at_) {
                hidden_ = hidden_by_flags(flags_of_vtk(image, info_.grid), chosen_, info_.grid);
                hidden_at_ = step;
            }
            values_of_vtk(image, chosen_, info_.grid, slices, hidden_, out, path_.string());
        });
    }

  private:
    void describe(const ReadOptions& options) {
        const std::string name = path_.string();
        vtkImageData& image = mesh_->image(0);
        const MeshSource& source = mesh_->source();
        info_.grid = grid_of_vtk(*reinterpret_cast<int(*)[6]>(image.GetExtent()), image.GetOrigin(),
                                 image.GetSpacing(), image.GetDirectionMatrix()->GetData(), name);
        chosen_ = choose_scalar(without_flags(arrays_of_vtk(image)), options, name);
        hidden_ = hidden_by_flags(flags_of_vtk(image, info_.grid), chosen_, info_.grid);
        chosen_.describe(info_);
        info_.times = mesh_->times();
        info_.length_unit = source.length_unit;
        info_.time_unit = info_.times.empty() ? "" : source.time_unit;
        info_.notes = source.notes;
        info_.notes.push_back(note_on_resampling(mesh_->data(), image, chosen_, hidden_));
        std::ranges::copy(chosen_.notes(), std::back_inserter(info_.notes));
        std::ranges::copy(notes_on_hidden(hidden_, chosen_.array.on_cells),
                          std::back_inserter(info_.notes));
        if (info_.times.empty())
            take_time_of_vtk(mesh_->data().GetFieldData(), info_);
        info_.value_unit = source.unit_of(chosen_.array.name);
        take_fields_of_vtk(mesh_->data(), chosen_, info_);
        if (auto note = note_on_unread(source.unread()))
            info_.notes.push_back(std::move(*note));
    }

    fs::path path_;
    std::shared_ptr<Mesh> mesh_; ///< shared with the file's other arrays
    ChosenScalar chosen_;
    std::vector<std::uint8_t> hidden_; ///< vertices, of the step `hidden_at_`
    std::size_t hidden_at_ = 0;
};

} // namespace

std::unique_ptr<DecodedFile> decode_mesh(const fs::path& path, const ReadOptions& options) {
    return std::make_unique<MeshFile>(path, options);
}

} // namespace isochron::index
