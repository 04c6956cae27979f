// After the Exodus II manual, the CGNS Standard Interface Data Structures, the user guides of OpenFOAM and AMReX.
#include "index/readers/decoders/mesh/mesh_fields.h"

#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>

#include <vtkExodusIIReader.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <system_error>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// The exponents of kilogram, meter, second, kelvin, mole, ampere and candela; none if the head of
/// a field gives no dimensions.
std::optional<std::array<double, 7>> dimensions_in(const std::string& head) {
    const std::size_t key = head.find("\ndimensions");
    const std::size_t open = key == head.npos ? key : head.find('[', key);
    if (open == head.npos)
        return std::nullopt;
    std::istringstream numbers(head.substr(open + 1, head.find(']', open) - open - 1));
    std::array<double, 7> dimensions{};
    for (double& one : dimensions) // the last two may be missing
        if (!(numbers >> one))
            one = 0;
    return dimensions;
}

/// The lines of an AMReX plotfile's Header.
class PlotfileHeader {
  public:
    explicit PlotfileHeader(const fs::path& path) : head_(head_of(path, kHead)) {}

    std::string next() { return std::string(trimmed(take_line(head_, at_))); }
    std::int64_t whole() {
        std::int64_t number = 0;
        std::istringstream(next()) >> number;
        return number;
    }
    void skip(std::int64_t lines) {
        for (std::int64_t i = 0; i < lines && at_ < head_.size(); ++i)
            take_line(head_, at_);
    }

  private:
    static constexpr std::size_t kHead = 1 << 20;
    std::string head_;
    std::size_t at_ = 0;
};

} // namespace

std::int64_t dimensions_of_amrex(const fs::path& path) {
    PlotfileHeader header(path);
    header.skip(1);
    header.skip(header.whole());
    return header.whole();
}

std::vector<std::string> unread_of_exodus(vtkExodusIIReader& reader) {
    std::vector<std::string> unread;
    for (const auto& [kind, what] : {std::pair(vtkExodusIIReader::SIDE_SET, "side sets"),
                                     {vtkExodusIIReader::NODE_SET, "node sets"},
                                     {vtkExodusIIReader::EDGE_BLOCK, "edge blocks"},
                                     {vtkExodusIIReader::FACE_BLOCK, "face blocks"},
                                     {vtkExodusIIReader::ELEM_SET, "element sets"}})
        if (const int count = reader.GetNumberOfObjects(kind); count > 0)
            unread.push_back(fmt::format("{} ({})", what, count));
    for (int i = 0; i < reader.GetNumberOfObjectArrays(vtkExodusIIReader::GLOBAL); ++i)
        unread.push_back(fmt::format("global variable {}",
                                     reader.GetObjectArrayName(vtkExodusIIReader::GLOBAL, i)));
    for (int i = 0; i < reader.GetNumberOfObjects(vtkExodusIIReader::ELEM_BLOCK); ++i)
        if (const int count = reader.GetNumberOfObjectAttributes(vtkExodusIIReader::ELEM_BLOCK, i);
            count > 0)
            unread.push_back(fmt::format("attributes of element block {} ({})", i + 1, count));
    return unread;
}

std::vector<std::string> unread_of_cgns(const fs::path& path) {
    constexpr std::size_t kHead = std::size_t{64} << 20; // its nodes, but for large arrays
    const std::string head = head_of(path, kHead);
    std::vector<std::string> unread;
    // The labels of nodes are text in both containers, ADF and HDF5.
    for (const char* label :
         {"DimensionalUnits_t", "DataClass_t", "DataConversion_t", "DimensionalExponents_t",
          "ReferenceState_t", "FlowEquationSet_t", "ConvergenceHistory_t", "ZoneBC_t",
          "ZoneGridConnectivity_t", "RigidGridMotion_t", "ArbitraryGridMotion_t",
          "RotatingCoordinates_t", "Axisymmetry_t", "Gravity_t", "Descriptor_t", "Family_t",
          "IntegralData_t", "UserDefinedData_t"})
        if (head.find(label) != head.npos)
            unread.emplace_back(label);
    return unread;
}

std::vector<std::string> unread_of_amrex(const fs::path& path) {
    PlotfileHeader header(path);
    header.skip(1);              // version
    header.skip(header.whole()); // names of the arrays
    header.skip(2);              // dimensions, time
    const std::int64_t levels = header.whole() + 1;
    header.skip(4); // corners, ratios, boxes
    const std::string steps = header.next();
    header.skip(levels); // spacing of each level
    std::vector<std::string> unread;
    if (steps.find_first_not_of("0 ") != steps.npos)
        unread.push_back(fmt::format("steps of the levels {}", excerpt(steps)));
    if (const std::string system = header.next(); !system.empty() && system != "0")
        unread.push_back(fmt::format("coordinate system {} (shown as cartesian)",
                                     system == "1"   ? "cylindrical"
                                     : system == "2" ? "spherical"
                                                     : excerpt(system)));
    std::vector<std::string> others; // as job_info and folders of particles
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path(), ignored))
        if (const std::string name = entry.path().filename().string();
            name != "Header" && !name.starts_with("Level_"))
            others.push_back(excerpt(name));
    std::sort(others.begin(), others.end());
    unread.insert(unread.end(), others.begin(), others.end());
    return unread;
}

std::string unit_of_openfoam(const std::vector<fs::path>& cases, const std::string& field) {
    constexpr std::size_t kHead = 1 << 14;
    std::error_code ignored;
    for (const fs::path& one : cases)
        for (const fs::directory_entry& time : fs::directory_iterator(one, ignored)) {
            const fs::path file = time.path() / field;
            if (!fs::is_regular_file(file, ignored))
                continue;
            const auto dimensions = dimensions_in(head_of(file, kHead));
            if (!dimensions)
                continue;
            constexpr std::array kBase{"kg", "m", "s", "K", "mol", "A", "cd"};
            std::string unit;
            for (std::size_t i = 0; i < kBase.size(); ++i)
                if (const double power = (*dimensions)[i]; power != 0)
                    unit += fmt::format("{}{}{}", unit.empty() ? "" : " ", kBase[i],
                                        power == 1 ? "" : fmt::format("{}", power));
            return unit;
        }
    return {};
}

} // namespace isochron::index
