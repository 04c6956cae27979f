// DICOM volumes: a file for each slice, or many frames in one.
#include "index/error.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/dicom/dicom_header.h"
#include "index/readers/decoders/dicom/dicom_phases.h"
#include "index/readers/decoders/dicom/dicom_pixels.h"
#include "index/readers/decoders/dicom/dicom_stack.h"
#include "index/readers/formats/stored_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

class DicomSeries final : public DecodedFile {
  public:
    DicomSeries(const fs::path& path, const ReadOptions& options)
        : paths_(options.slices.empty() ? std::vector{path} : options.slices) {
        std::size_t without = 0;
        for (std::size_t i = 0; i < paths_.size(); ++i) {
            names_.push_back(paths_[i].string());
            files_.push_back(read_dicom_header(paths_[i], i));
            without += files_.back().images.empty();
        }
        std::vector<DicomVolume> volumes = dicom_volumes(files_);
        if (volumes.empty())
            throw Error("{}: holds no image", path.string());
        choose(volumes, options, path.string());
        describe();
        if (without > 0)
            info_.notes.push_back(
                fmt::format("{} of {} files hold no image", without, paths_.size()));
    }

    std::size_t steps() const override { return stack_.steps.size(); }
    std::uint32_t slices_at_once() const override { return slices_worth_asking(info_); }
    std::uint64_t decoded_bytes() const override {
        const DicomFile& file = file_of(stack_.steps.front().front());
        return std::uint64_t{file.columns} * file.rows * file.samples * size_of(file.type) *
               (DicomPixels::by_frame(file) && file.tiles_across == 1 ? 1 : file.frames);
    }

    void read(std::size_t step, Slices slices, std::span<std::byte> out) override {
        const std::size_t page = out.size() / slices.count;
        Grid slice = info_.grid;
        slice.vertices[2] = 1;
        for (std::uint32_t i = 0; i < slices.count; ++i) {
            const DicomImage& image = stack_.steps[step][slices.first + i];
            const DicomFile& file = file_of(image);
            const std::string& name = names_[image.file];
            convert_planes(chosen_, slice, out.subspan(i * page, page), name,
                           [&](std::size_t sample, std::span<std::byte> plane) {
                               if (!rescaled_)
                                   return pixels_.read(paths_[image.file], file, image.frame,
                                                       sample, plane);
                               stored_.resize(slice.vertex_count() * size_of(file.type));
                               pixels_.read(paths_[image.file], file, image.frame, sample, stored_);
                               rescale(file.type, image.scaling, plane);
                           });
        }
    }

  private:
    const DicomFile& file_of(const DicomImage& image) const { return files_[image.file]; }

    void choose(std::vector<DicomVolume>& volumes, ReadOptions options, const std::string& name) {
        const std::size_t series = volumes.size(), phases = join_phases(volumes, files_, names_);
        if (phases == series && !options.array) {
            options.array = volumes.front().name;
            info_.notes.push_back(fmt::format(
                "{} series are the phases of one scan; --array NAME reads one", phases));
        }
        std::vector<StoredArray> offered;
        for (const DicomVolume& volume : volumes) {
            const DicomFile& file = file_of(volume.images.front());
            offered.push_back(
                {.name = volume.name,
                 .type = type_of(volume),
                 .components = file.samples,
                 .shape = fmt::format("{} x {}, {} image{}", file.columns, file.rows,
                                      volume.images.size(), volume.images.size() == 1 ? "" : "s")});
        }
        chosen_ = choose_scalar(offered, options, name);
        const auto at = std::ranges::find(offered, chosen_.array.name, &StoredArray::name);
        DicomVolume& volume = volumes[static_cast<std::size_t>(at - offered.begin())];
        const DicomFile& file = file_of(volume.images.front());
        rescaled_ = type_of(volume) != file.type;
        stack_ = dicom_stack(volume.images, file, names_, options.spacing.has_value());
    }

    /// Values that each slice scales in its own way are scaled when they are read.
    StoredType type_of(const DicomVolume& volume) const {
        const Scaling& first = volume.images.front().scaling;
        const bool same = std::ranges::all_of(
            volume.images, [&](const DicomImage& image) { return image.scaling == first; });
        const StoredType stored = file_of(volume.images.front()).type;
        return same ? stored : size_of(stored) > 2 ? StoredType::f64 : StoredType::f32;
    }

    void describe() {
        const DicomImage& image = stack_.steps.front().front();
        const DicomFile& file = file_of(image);
        info_.grid = stack_.grid;
        expect_few_steps(stack_.steps.size(), names_.front());
        chosen_.describe(info_);
        if (!rescaled_)
            info_.scaling = image.scaling;
        info_.value_unit = file.value_unit;
        if (stack_.in_space || image.spacing)
            info_.length_unit = "mm";
        if (stack_.in_space && file.of_patient)
            info_.anatomy = Anatomy::lps;
        info_.times = stack_.times;
        info_.time_unit = stack_.time_unit;
        for (const auto& notes : {chosen_.notes(), file.notes, stack_.notes})
            info_.notes.insert(info_.notes.end(), notes.begin(), notes.end());
        if (rescaled_)
            info_.notes.push_back(fmt::format("each slice has a slope and intercept of its own: "
                                              "values are scaled, as {}",
                                              name_of(info_.type)));
    }

    void rescale(StoredType type, const Scaling& scaling, std::span<std::byte> plane) const {
        visit_stored_type(type, [&]<class From>(std::type_identity<From>) {
            const auto* from = reinterpret_cast<const From*>(stored_.data());
            const std::size_t count = stored_.size() / sizeof(From);
            const auto to = [&]<class To>(To* out) {
                for (std::size_t i = 0; i < count; ++i)
                    out[i] = static_cast<To>(scaling(static_cast<double>(from[i])));
            };
            if (plane.size() == count * sizeof(float))
                to(reinterpret_cast<float*>(plane.data()));
            else
                to(reinterpret_cast<double*>(plane.data()));
        });
    }

    std::vector<fs::path> paths_;
    std::vector<std::string> names_;
    std::vector<DicomFile> files_;
    DicomStack stack_;
    ChosenScalar chosen_;
    bool rescaled_ = false;
    DicomPixels pixels_;
    std::vector<std::byte> stored_; ///< a plane before it is scaled
};

} // namespace

std::unique_ptr<DecodedFile> decode_dicom(const fs::path& path, const ReadOptions& options) {
    return std::make_unique<DicomSeries>(path, options);
}

} // namespace isochron::index
