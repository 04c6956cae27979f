// Reads ParaView collections (.pvd): files and their times.
#include "index/error.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/vtk/vtk_session.h"
#include "index/readers/decoders/vtk/xml_markup.h"
#include "index/readers/formats/named_file.h"
#include "index/system/mapped_file.h"

#include <fmt/format.h>

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <cmath>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

void read_collection(const fs::path& path, ListedFiles& files) {
    const std::string name = path.string();
    {
        const MappedFile file(path);
        expect_shallow({reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()},
                       name);
    }
    const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
        vtkXMLUtilities::ReadElementFromFile(path.c_str()));
    vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
    if (!collection)
        throw Error(fmt::format("{}: not a ParaView collection", name));
    for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
        vtkXMLDataElement* set = collection->GetNestedElement(i);
        if (std::string_view(set->GetName()) != "DataSet")
            continue;
        const char* file = set->GetAttribute("file");
        double time = 0;
        if (!file)
            throw Error(fmt::format("{}: DataSet {} names no file", name, i));
        const char* text = set->GetAttribute("timestep");
        if (!text)
            throw Error(fmt::format("{}: {} has no timestep", name, file));
        if (!set->GetScalarAttribute("timestep", time) || !std::isfinite(time))
            throw Error(
                fmt::format("{}: {}: timestep \"{}\", expected a number", name, file, text));
        const char *part = set->GetAttribute("part"), *group = set->GetAttribute("group");
        files.push_back({.path = file_named_in(path, file),
                         .time = time,
                         .part = fmt::format("{} of {}", part ? part : "0", group ? group : "")});
    }
    if (files.empty())
        throw Error(fmt::format("{}: an empty collection", name));
}

} // namespace

ListedFiles decode_pvd(const fs::path& path) {
    ListedFiles files;
    with_vtk(path, [&] { read_collection(path, files); });
    return files;
}

} // namespace isochron::index
