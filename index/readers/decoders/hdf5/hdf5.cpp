// Opens HDF5 datasets by their path.
#include "index/error.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/hdf5/athena.h"
#include "index/readers/decoders/hdf5/bigdataviewer.h"
#include "index/readers/decoders/hdf5/hdf5_stated.h"
#include "index/readers/decoders/hdf5/hdf5_times.h"
#include "index/readers/decoders/hdf5/hdf5_volume.h"
#include "index/readers/decoders/hdf5/vtkhdf.h"
#include "index/readers/formats/stored_file.h"

#include <utility>

namespace isochron::index {

namespace {

/// Formats within HDF5 that need more than their datasets: what they are, and the way out.
void expect_no_other_format(const Hdf5File& file) {
    const auto refuse = [&](const char* what, const char* way_out) {
        throw Error("{}: {}, expected volumes as plain datasets; {}", file.name(), what, way_out);
    };
    if (file.holds("/minc-2.0"))
        refuse("MINC 2, which scales each slice in its own way",
               "mnc2nii of the MINC tools makes NIfTI of it");
    if (!file.texts("/", "ImarisDataSet").empty() || file.holds("/DataSetInfo/Image"))
        refuse("an Imaris file, whose datasets are padded",
               "bfconvert IN OUT.ome.tif of Bio-Formats makes OME-TIFF of it");
    if (file.holds("/bounding box") && file.holds("/refine level"))
        refuse("FLASH's blocks of a refined grid",
               "yt's covering_grid makes a regular grid of them");
    if (file.holds("/Grid00000001"))
        refuse("Enzo's boxes of a refined grid", "yt's covering_grid makes a regular grid of them");
    if (file.holds("/_silolibinfo"))
        refuse("Silo, whose datasets are flat", "VisIt exports them as VTK");
    if (file.text("/", "label") == "Root Node of HDF5 File")
        refuse("CGNS", "name it .cgns");
    if (!file.text("/", "nwb_version").empty())
        refuse("NWB, whose pictures follow each other in time", "--array /PATH reads one of its "
                                                                "datasets all the same");
    if (file.holds("/Chombo_global"))
        refuse("Chombo's boxes of a refined grid",
               "yt's covering_grid makes a regular grid of them");
}

} // namespace

std::unique_ptr<DecodedFile> decode_hdf5(const std::filesystem::path& path,
                                         const ReadOptions& options) {
    auto file = std::make_unique<Hdf5File>(path, options.crop.has_value());
    if (!(options.array && options.array->starts_with('/')))
        expect_no_other_format(*file);
    if (is_vtkhdf(*file) && !(options.array && options.array->starts_with('/')))
        return decode_vtkhdf(std::move(file), options);
    if (is_athena(*file) && !(options.array && options.array->starts_with('/')))
        return decode_athena(std::move(file), options);
    const bool of_views = is_bigdataviewer(*file);
    ReadOptions asked = options;
    if (of_views && !options.array && !options.any_array)
        asked.array = view_of_bigdataviewer(*file);
    const Hdf5Array array = choose_array(*file, asked);
    const Hdf5Dataset& first = array.steps.front();
    if (!first.type)
        throw Error("{}: {} does not hold numbers that can be read", file->name(), first.path);
    StatedArray record = stated(*file, first, true);
    record.name = array.name;
    std::vector<std::string> notes;
    const ArrayLayout layout = lay_out(record, objects_of(*file, first), options, notes);
    take_coordinates(*file, first, layout, record, notes);
    if (of_views)
        take_bigdataviewer(*file, first, record, notes);
    Hdf5Volume volume{{}, array.steps, layout};
    volume.member = member_of(record, layout, options);
    volume.info.notes = std::move(notes);
    if (layout.time && array.steps.size() > 1)
        throw Error(
            "{}: {} ({}): each of {} groups holds several steps, choose one with --array {}",
            file->name(), array.name, shape_text(first.dimensions), array.steps.size(), first.path);
    volume.info.arrays = array.offered;
    if (array.note)
        volume.info.notes.push_back(*array.note);
    size_grid(*file, volume);
    const std::size_t steps = layout.time ? first.dimensions[*layout.time] : array.steps.size();
    expect_few_steps(steps, file->name());
    place_axes(record, layout, options, volume.info);
    time_hdf5(*file, array, record, layout, steps, options, volume.info);
    if (array.steps.size() > 1 && !volume.info.times.empty()) // the last ones may have none
        volume.datasets.resize(volume.info.times.size());
    return open_volume(std::move(file), array.name, std::move(volume), options);
}

} // namespace isochron::index
