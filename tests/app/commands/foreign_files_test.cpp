// Files that libraries decode: damaged ones, and the program started from any folder.
#include "index/readers/process/reader_start.h"
#include "tests/app/commands/command_line.h"

#include <set>

namespace isochron::app {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace fs = std::filesystem;

const fs::path kData = test_support::test_data();

class ForeignFiles : public CommandLine {
  protected:
    ChildResult build(const std::string& file) {
        return isochron({"build", file, "-o", "a.isochron"});
    }
};

TEST_F(ForeignFiles, ThatAreDamagedCostOneLine) {
    const auto before = folder.names();
    int files = 0;
    for (const auto& entry : fs::directory_iterator(kData / "damaged")) {
        const ChildResult result = build(entry.path().string());
        ++files;
#ifdef ISOCHRON_NETCDF_SKIPS_HEAPS // netCDF 4.9.3 reads nothing of the damaged part
        if (entry.path().filename() == "global_heap.nc") {
            EXPECT_EQ(result.status, 0) << result.err;
            fs::remove(folder.path() / "a.isochron");
            continue;
        }
#endif
        expect_failure(result, 1, entry.path().string() + ": ");
        // In our words: neither a library's places nor a container's.
        for (const char* dump : {"ERROR:", "In /", "vtk", "std::", "vector::", "0x"})
            EXPECT_THAT(result.err.substr(result.err.find(": ", 20)), Not(HasSubstr(dump)));
        EXPECT_EQ(folder.names(), before);
    }
    EXPECT_EQ(files, 8);
}

TEST_F(ForeignFiles, OfElementsNestedWithoutEndCostOneLine) {
    std::string nested;
    for (int i = 0; i < 300'000; ++i)
        nested += "<a>";
    const std::string image = "<VTKFile type=\"ImageData\"><ImageData>";
    folder.write("deep.vti", image + nested + "</VTKFile>");
    folder.write("deep.pvd", "<VTKFile type=\"Collection\"><Collection>" + nested);
    for (const std::string name : {"deep.vti", "deep.pvd"})
        expect_failure(build(name), 1, name + ": elements nested more than 64 deep");
}

using LinksThatLeadOut = ForeignFiles;

TEST_F(LinksThatLeadOut, AreOneLineUnlessTheirFolderIsAllowed) {
    const std::string image = (kData / "vti" / "ascii.vti").string(),
                      allowed = (kData / "vti").string();
    folder.write("out.pvd",
                 "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"" +
                     image + "\"/></Collection></VTKFile>");
    folder.write(
        "out.pvti",
        "<VTKFile type=\"PImageData\" version=\"1.0\"><PImageData WholeExtent=\"2 6 -1 2 0 2\" "
        "GhostLevel=\"0\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><PPointData>"
        "<PDataArray type=\"Int16\" Name=\"p\"/></PPointData>"
        "<Piece Extent=\"2 6 -1 2 0 2\" Source=\"" +
            image + "\"/></PImageData></VTKFile>");
    fs::create_symlink(image, folder.path() / "link.vti");
    // What the sanitizers watch has no fence, so that it reads what the .pvti names.
    const std::vector<std::string> refused = index::kReaderIsWatched
                                                 ? std::vector<std::string>{"out.pvd"}
                                                 : std::vector<std::string>{"out.pvd", "out.pvti"};
    for (const std::string& name : refused) {
        const ChildResult result = build(name);
        expect_failure(result, 1, name + ": names " + image + ", outside of the folders");
        EXPECT_THAT(result.err, HasSubstr("--allow " + allowed));
        EXPECT_EQ(isochron({"build", name, "-o", "a.isochron", "--allow", allowed}).status, 0);
    }
    EXPECT_EQ(build("link.vti").status, 0) << "what the user names is read wherever it lies";
}

TEST_F(ForeignFiles, AreReadWhereverTheProgramIsStartedFrom) {
    const std::string binary = test_support::binary_root();
    const std::string vti = (kData / "vti" / "raw_zlib64.vti").string();
    ASSERT_EQ(build(vti).status, 0);
    const std::string expected = folder.read("a.isochron");
    fs::create_symlink(binary + "/isochron", folder.path() / "linked");
    fs::create_directory_symlink(binary, folder.path() / "there");
    const std::string relative = fs::relative(binary + "/isochron", folder.path()).string();
    for (const std::string program : {"./linked", "there/isochron", relative.c_str()}) {
        fs::remove(folder.path() / "a.isochron");
        const ChildResult result =
            run_child(program, {"build", vti, "-o", "a.isochron"}, folder.path());
        EXPECT_EQ(result.status, 0) << program << ": " << result.err;
        EXPECT_EQ(folder.read("a.isochron"), expected) << program;
    }
    const ChildResult by_path = run_child(
        "/usr/bin/env",
        {"PATH=" + binary + ":/usr/bin:/bin", "isochron", "build", vti, "-o", "b.isochron"},
        folder.path());
    EXPECT_EQ(by_path.status, 0) << by_path.err;
    EXPECT_EQ(folder.read("b.isochron"), expected);
}

TEST_F(ForeignFiles, WithoutAReaderAreRefusedAndOthersAreRead) {
    // Neither the folder that it is started in nor the one above it is where a reader is looked
    // for.
    const fs::path program = folder.path() / "bin" / "isochron";
    fs::create_directory(program.parent_path());
    fs::copy_file(test_support::binary_root() + "/isochron", program);
    fs::copy_file("/bin/true", folder.path() / "isochron-reader-vti");
    const auto run = [&](const std::vector<std::string>& arguments) {
        return run_child(program.string(), arguments, folder.path());
    };
    const std::string vti = (kData / "vti" / "ascii.vti").string();
    expect_failure(run({"build", vti, "-o", "b.isochron"}), 1,
                   vti + ": cannot be read: isochron-reader-vti: not found beside the program");
    EXPECT_EQ(run(build_of("t*.raw", {"--quiet"})).status, 0);
    // One that is no reader says so, too.
    fs::copy_file("/bin/true", program.parent_path() / "isochron-reader-vti");
    expect_failure(run({"build", vti, "-o", "b.isochron"}), 1,
                   vti + ": cannot be read: at the start: its reader ended with status 0");
}

TEST_F(ForeignFiles, AreDecodedByNoLibraryOfTheProgramItself) {
    const ChildResult libraries = run_child(
        "/usr/bin/env", {"LD_TRACE_LOADED_OBJECTS=1", test_support::binary_root() + "/isochron"},
        folder.path());
    EXPECT_THAT(libraries.out, HasSubstr("libstdc++"));
    for (const char* library : {"vtk", "netcdf", "hdf5", "expat"})
        EXPECT_THAT(libraries.out, Not(HasSubstr(library)));
}

} // namespace
} // namespace isochron::app
