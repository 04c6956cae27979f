// Image data as VTK writes them, in all types, encodings, packings and byte orders: what is read is what VTK reads.
#include "index/readers/decoders/decoders.h"
#include "tests/support/child_process.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

#include <cstring>
#include <sstream>

namespace isochron::index {
namespace {

TEST(VtiByVtk, IsReadAsVtkReadsIt) {
    const TestFolder folder;
    const app::ChildResult written = app::run_child(
        "/usr/bin/python3",
        {"-B", test_support::source_root() + "/tests/index/readers/decoders/vti_by_vtk.py", "."},
        folder.path());
    ASSERT_EQ(written.status, 0) << written.err;
    std::istringstream list(written.out);
    int files = 0;
    for (std::string name, array, expected; list >> name >> array >> expected; ++files) {
        SCOPED_TRACE(name + " " + array);
        ReadOptions options;
        options.array = array;
        const auto file = decode_vti(folder.path() / name, options);
        const SeriesInfo& info = file->info();
        EXPECT_EQ(info.grid.vertices, (std::array<std::uint32_t, 3>{5, 4, 3}));
        EXPECT_EQ(info.grid.spacing, glm::dvec3(0.5, 1, 2));
        EXPECT_EQ(info.grid.direction, glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1));
        EXPECT_EQ(info.grid.origin, glm::dvec3(10 + 1, 20 + 1, 30)); // vertex 2 -1 0
        EXPECT_EQ(info.times, std::vector<double>{2.5});
        std::vector<std::byte> values(info.step_bytes());
        file->read(0, {0, 3}, values);
        const std::string bytes = read_file(folder.path() / expected);
        ASSERT_EQ(values.size(), bytes.size());
        EXPECT_EQ(std::memcmp(values.data(), bytes.data(), bytes.size()), 0);
    }
    EXPECT_GT(files, 1300);
}

} // namespace
} // namespace isochron::index
