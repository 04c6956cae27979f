// Reads VTK XML image data (.vti) with vtkXMLImageDataReader, in all encodings and compressors.
#include "index/error.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/vtk/vtk_fields.h"
#include "index/readers/decoders/vtk/vtk_ghosts.h"
#include "index/readers/decoders/vtk/vtk_session.h"
#include "index/readers/decoders/vtk/xml_markup.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/stored_file.h"
#include "index/system/mapped_file.h"

#include <fmt/format.h>

#include <vtkDataArraySelection.h>
#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkXMLImageDataReader.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

// Every piece gives its part of the vertices; where one is missing VTK would leave zeros. Pieces
// may overlap.
void expect_whole(std::string_view markup, const Grid& grid, const std::string& file) {
    std::uint64_t cells = 0;
    for (std::size_t at = markup.find("<Piece"); at != std::string_view::npos;
         at = markup.find("<Piece", at + 1)) {
        const std::string_view tag = markup.substr(at, markup.find('>', at) - at);
        const std::size_t key = tag.find("Extent");
        const std::size_t quote = key == tag.npos ? tag.npos : tag.find_first_of("\"'", key);
        if (quote == tag.npos)
            continue;
        std::istringstream numbers{std::string(tag.substr(quote + 1))};
        std::int64_t e[6]{};
        for (std::int64_t& number : e)
            numbers >> number;
        std::uint64_t piece = 1;
        for (int axis = 0; axis < 3; ++axis)
            piece *= static_cast<std::uint64_t>(
                std::max<std::int64_t>(e[2 * axis + 1] - e[2 * axis], 0));
        cells += piece;
    }
    if (cells < grid.cell_count())
        throw Error(fmt::format("{}: its pieces hold {} cells, the whole extent has {}", file,
                                cells, grid.cell_count()));
}

// Checks that the file is large enough. A value takes at least a digit and a blank as text, and 4/3
// of its size in base64. The best ratios of VTK's compressors are below 1:10,000 (LZMA), 1:1,032
// (zlib) and 1:255 (LZ4).
void expect_bytes(std::string_view markup, const ChosenScalar& chosen, const Grid& grid,
                  std::uint64_t size, const std::string& file) {
    std::uint64_t best = 1;
    if (markup.find("compressor") != markup.npos)
        best = markup.find("LZMA") != markup.npos ? 10'000 : 1'032;
    const std::uint64_t tuples = chosen.array.on_cells ? grid.cell_count() : grid.vertex_count();
    const std::uint64_t stored = tuples * chosen.array.components;
    // The time may be ascii although values are compressed.
    const bool text = best == 1 && markup.find("ascii") != markup.npos;
    const std::uint64_t least = text ? stored : stored * size_of(*chosen.array.type) / best;
    if (least > size)
        throw Error(
            fmt::format("{}: truncated: {} vertices in {} bytes", file, grid.vertex_count(), size));
}

void select_only(vtkDataArraySelection* selection, const std::string& name) {
    selection->DisableAllArrays();
    if (!name.empty())
        selection->EnableArray(name.c_str());
}

class VtiFile final : public DecodedFile {
  public:
    VtiFile(fs::path path, const ReadOptions& options) : path_(std::move(path)) {
        const std::string name = path_.string();
        const MappedFile file(path_);
        const std::string_view markup = markup_of(file);
        if (markup.find("<VTKFile") == markup.npos || markup.find("ImageData") == markup.npos)
            throw Error(fmt::format("{}: not VTK XML image data", name));
        expect_end(file, name);
        expect_shallow(markup, name);
        expect_names(markup, name);
        take_infinities(markup, file);
        with_vtk(path_, [&] {
            reader_->SetFileName(path_.c_str());
            reader_->UpdateInformation();
        });
        // A second call, since VTK's information is complete only if the first reported no error.
        with_vtk(path_, [&] { describe(options); });
        take_fields_of_markup(markup, chosen_, info_);
        if (markup.find("vtkLZ4DataCompressor") != markup.npos)
            info_.notes.push_back(
                "LZ4 data of VTK carry no check: damage to them may go unnoticed");
        expect_whole(markup, info_.grid, name);
        expect_bytes(markup, chosen_, info_.grid, file.bytes().size(), name);
        with_vtk(path_, [&] {
            // Without arrays VTK reads only the time; arrays of flags add little.
            select({});
            if (chosen_.array.gaps)
                for (const char* flags : kGhostFlags) {
                    reader_->GetPointDataArraySelection()->EnableArray(flags);
                    reader_->GetCellDataArraySelection()->EnableArray(flags);
                }
            reader_->Update();
            hidden_ = hidden_by_flags(*reader_->GetOutput(), chosen_, info_.grid);
            std::ranges::copy(notes_on_hidden(hidden_, chosen_.array.on_cells),
                              std::back_inserter(info_.notes));
            take_time_of_vtk(reader_->GetOutput()->GetFieldData(), info_);
        });
    }

    const SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override { return 1; }

    std::uint32_t slices_at_once() const override { return slices_of_vtk(chosen_, info_); }
    std::uint64_t decoded_bytes() const override { return bytes_of_vtk(chosen_, info_.grid); }

    void read(std::size_t, Slices slices, std::span<std::byte> out) override {
        with_vtk(path_, [&] {
            if (!std::exchange(decoded_, true)) { // selecting again would make VTK read again
                select(chosen_.array);
                reader_->Update();
            }
            values_of_vtk(*reader_->GetOutput(), chosen_, info_.grid, slices, hidden_, out,
                          path_.string());
        });
        if (replaced_)
            visit_value_type(info_.type, [&]<class T>(std::type_identity<T>) {
                const std::span<T> values(reinterpret_cast<T*>(out.data()), out.size() / sizeof(T));
                if constexpr (std::is_floating_point_v<T>)
                    std::ranges::replace(values, static_cast<T>(kLowest),
                                         -std::numeric_limits<T>::infinity());
            });
    }

  private:
    // Replaces infinities that VTK reads wrongly; only numbers as text can have them.
    void take_infinities(std::string_view markup, const MappedFile& file) {
        if (markup.find("ascii") == markup.npos || !holds_hard_infinities(markup))
            return;
        const std::string_view all(reinterpret_cast<const char*>(file.bytes().data()),
                                   file.bytes().size());
        std::optional<std::string> text = with_easy_infinities(markup);
        if (!text)
            throw Error(fmt::format("{}: holds -inf beside {}, which VTK cannot tell apart",
                                    path_.string(), kLowest));
        reader_->SetInputString(*text + std::string(all.substr(markup.size())));
        reader_->ReadFromInputStringOn();
        replaced_ = true;
    }

    void describe(const ReadOptions& options) {
        const std::string name = path_.string();
        vtkInformation* out = reader_->GetOutputInformation(0);
        if (!out->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
            throw Error(fmt::format("{}: not VTK XML image data", name));
        int extent[6];
        out->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
        constexpr double kIdentity[9]{1, 0, 0, 0, 1, 0, 0, 0, 1};
        info_.grid = grid_of_vtk(
            extent, out->Get(vtkDataObject::ORIGIN()), out->Get(vtkDataObject::SPACING()),
            out->Has(vtkDataObject::DIRECTION()) ? out->Get(vtkDataObject::DIRECTION()) : kIdentity,
            name);
        std::vector<StoredArray> arrays;
        add_arrays(out->Get(vtkDataObject::POINT_DATA_VECTOR()), false, arrays);
        add_arrays(out->Get(vtkDataObject::CELL_DATA_VECTOR()), true, arrays);
        chosen_ = choose_scalar(without_flags(std::move(arrays)), options, name);
        info_.arrays = chosen_.offered;
        info_.array = chosen_.label();
        info_.type = chosen_.value_type();
        info_.notes = chosen_.notes();
    }

    static void add_arrays(vtkInformationVector* listed, bool on_cells,
                           std::vector<StoredArray>& arrays) {
        for (int i = 0; listed && i < listed->GetNumberOfInformationObjects(); ++i) {
            vtkInformation* array = listed->GetInformationObject(i);
            arrays.push_back({array->Get(vtkDataObject::FIELD_NAME()),
                              stored_type_of_vtk(array->Get(vtkDataObject::FIELD_ARRAY_TYPE())),
                              static_cast<std::uint32_t>(
                                  array->Get(vtkDataObject::FIELD_NUMBER_OF_COMPONENTS())),
                              on_cells});
        }
    }

    void select(const StoredArray& array) {
        select_only(reader_->GetPointDataArraySelection(), array.on_cells ? "" : array.name);
        select_only(reader_->GetCellDataArraySelection(), array.on_cells ? array.name : "");
    }

    fs::path path_;
    SeriesInfo info_;
    ChosenScalar chosen_;
    std::vector<std::uint8_t> hidden_;
    bool replaced_ = false; ///< -inf has been replaced by kLowest
    bool decoded_ = false;  ///< VTK has read the values, or has tried to
    vtkNew<vtkXMLImageDataReader> reader_;
};

} // namespace

std::unique_ptr<DecodedFile> decode_vti(const fs::path& path, const ReadOptions& options) {
    return std::make_unique<VtiFile>(path, options);
}

} // namespace isochron::index
