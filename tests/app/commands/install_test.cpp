// The installed tree: it works at any place, other programs build against it, and removing its
// package leaves nothing.
#include "tests/app/commands/command_line.h"

#include <sstream>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Installed : public CommandLine {
  protected:
    /// Runs a shell's command in the test's folder; fails the test where it fails.
    std::string shell(const std::string& command) {
        const ChildResult result = run_child("/bin/sh", {"-ec", command}, folder.path());
        EXPECT_EQ(result.status, 0) << command << '\n' << result.out << result.err;
        return result.out;
    }
    /// Installs into `prefix`, below the test's folder.
    void install(const std::string& prefix, const std::string& component) {
        shell(fmt::format("cmake --install '{}' --prefix '{}' --component {}",
                          test_support::binary_root(), (folder.path() / prefix).string(),
                          component));
    }
    /// Regular files and links below a folder, sorted.
    static std::vector<std::string> files_below(const fs::path& place) {
        std::vector<std::string> found;
        if (!fs::exists(place))
            return found;
        for (const auto& entry : fs::recursive_directory_iterator(place))
            if (!entry.is_directory())
                found.push_back(entry.path().string());
        std::ranges::sort(found);
        return found;
    }
};

TEST_F(Installed, WorksFromAnyPrefixAndWhereItIsMovedTo) {
    install("first", "program");
    install("first", "generate");
    fs::create_directories(folder.path() / "elsewhere");
    fs::rename(folder.path() / "first", folder.path() / "elsewhere" / "moved to");
    // What lies in the working directory under the names of modules and readers is not taken.
    folder.write("libisochron_images.so", "no module");
    folder.write("isochron-reader-vti", "no reader");
    const std::string program = "'elsewhere/moved to/bin/isochron'";
    EXPECT_THAT(shell(program + " --version"), HasSubstr("commit "));
    shell(program +
          " generate sphere --out sphere >/dev/null"); // .vti: of the reader of VTK's files
    shell(program + " build sphere/*.pvd -o sphere.isochron");
    shell(program +
          " replay 'elsewhere/moved to/share/isochron/configs/demo.jsonl' --data sphere.isochron "
          "--any-data --context egl --size 64 64 --stamps --out pictures");
    EXPECT_THAT(shell("file pictures/*"), HasSubstr("PNG image data, 64 x 64"));
}

/// Where the program stands beside a module whose library, by its name, is on no machine.
TEST_F(Installed, WithoutOpenImageIOOneLineNamesThePackage) {
    install("tree", "program");
    const std::string module = "tree/libexec/isochron/libisochron_images.so";
    std::string bytes = folder.read(module);
    for (std::size_t at; (at = bytes.find("libOpenImageIO")) != bytes.npos;)
        bytes.replace(at, 14, "libMissingImIO");
    folder.write(module, bytes);
    folder.write("a.png", "a picture");
    const ChildResult result = run_child((folder.path() / "tree/bin/isochron").string(),
                                         {"reproduce", "a.png"}, folder.path());
    expect_failure(result, 1, "a.png: pictures need the package libopenimageio");
    EXPECT_THAT(result.err, HasSubstr("libMissingImIO"));
}

/// What stands in packages of its own is named with its package where it is needed.
TEST_F(Installed, WithoutAComponentOneLineNamesItsPackage) {
    install("tree", "program");
    const std::string program = (folder.path() / "tree/bin/isochron").string();
    const std::string missing = ": not found beside the program in " +
                                (folder.path() / "tree/bin").string() + "; `apt install ";
    for (const char* file : {"a.vtk", "a.vtu", "a.vtr", "a.pvti"}) {
        folder.write(file, "");
        const ChildResult result = run_child(program, {"info", file}, folder.path());
        expect_failure(result, 1, "isochron-reader-vtk" + missing + "isochron-readers-vtk`");
    }
    expect_failure(run_child(program, {"generate", "sphere", "-o", "d"}, folder.path()), 1,
                   "isochron-generate" + missing + "isochron-generate`");
    const ChildResult job = run_child(
        "/usr/bin/env", {"OMPI_COMM_WORLD_SIZE=2", program, "build", "a.vti", "-o", "a.isochron"},
        folder.path());
    expect_failure(job, 1, "libisochron_mpi.so" + missing + "isochron-mpi`");
    const std::string image = test_support::test_data() + "/vti/raw_zlib64.vti";
    EXPECT_EQ(run_child(program, {"info", image}, folder.path()).status, 0);
}

#ifdef ISOCHRON_WITH_PYTHON
/// The interpreter has none of the program's files; what the module needs lies where it was installed.
TEST_F(Installed, PythonFindsReadersFromThePlaceOfItsModule) {
    for (const char* component : {"program", "generate", "python"})
        install("first", component);
    fs::rename(folder.path() / "first", folder.path() / "moved to");
    folder.write("isochron-reader-vti", "no reader");
    shell("'moved to/bin/isochron' generate sphere --out sphere >/dev/null");
    const std::string python =
        "PYTHONPATH='moved to/lib/python3/dist-packages' /usr/bin/python3 -B -c ";
    EXPECT_EQ(shell(python + "'import isochron; "
                             "run = isochron.build(\"sphere/*.vti\", \"sphere.isochron\"); "
                             "print(run.cells(0.5).size > 0)'"),
              "True\n");
    fs::rename(folder.path() / "moved to/libexec", folder.path() / "gone");
    EXPECT_THAT(shell(python + "'import isochron\n"
                               "try: isochron.build(\"sphere/*.vti\", \"sphere.isochron\")\n"
                               "except isochron.Error as error: print(error)'"),
                HasSubstr("isochron-reader-vti: not found beside the program in "));
}
#endif

TEST_F(Installed, HasAManualPageAndCompletionsForEachCommand) {
    install("tree", "program");
    const fs::path share = folder.path() / "tree" / "share";
    std::istringstream help(isochron({"--help"}).out);
    std::string line;
    while (std::getline(help, line) && line != "Commands to begin with:") {
    }
    std::vector<std::string> commands;
    while (std::getline(help, line) && line != "Options:")
        if (line.starts_with("  ") && line.size() > 2 && line[2] != ' ')
            commands.push_back(line.substr(2, line.find(' ', 2) - 2));
    ASSERT_GE(commands.size(), 10u);
    const std::string bash = folder.read("tree/share/bash-completion/completions/isochron");
    const std::string zsh = folder.read("tree/share/zsh/vendor-completions/_isochron");
    const std::string fish = folder.read("tree/share/fish/vendor_completions.d/isochron.fish");
    for (const std::string& command : commands) {
        EXPECT_TRUE(fs::exists(share / "man/man1" / fmt::format("isochron-{}.1.gz", command)));
        EXPECT_THAT(bash, HasSubstr(fmt::format("'isochron {}'", command)));
        EXPECT_THAT(zsh, HasSubstr(fmt::format("_isochron_{}()", command)));
        EXPECT_THAT(fish, HasSubstr(fmt::format("-a {} ", command)));
    }
    const auto completed = [&](const std::string& words, int at) {
        return shell(fmt::format(
            "bash -c '. tree/share/bash-completion/completions/isochron; COMP_WORDS=({}); "
            "COMP_CWORD={}; _isochron; echo ${{COMPREPLY[*]}}'",
            words, at));
    };
    EXPECT_EQ(completed("isochron ver", 1), "verify\n");
    EXPECT_EQ(completed("isochron generate sp", 2), "sphere\n");
    EXPECT_EQ(completed("isochron build --app", 2), "--append\n");
    EXPECT_EQ(completed("isochron replay --context os", 3), "osmesa\n");
    EXPECT_EQ(completed("isochron build --out v", 3), "\n"); // a file: the shell's own names
}

TEST_F(Installed, LibraryServesAnotherProject) {
    install("tree", "library");
    shell(fmt::format(
        "cmake -S '{}/tests/examples/list_cells' -B example -DCMAKE_PREFIX_PATH=$PWD/tree >log && "
        "cmake --build example >>log || (cat log; exit 1)",
        test_support::source_root()));
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    std::string expected;
    for (const std::uint32_t id : active(0, 0.1))
        expected += fmt::format("{}\n", id);
    EXPECT_EQ(shell("example/list_cells a.isochron 0.1"), expected);
}

TEST_F(Installed, PackagesComeAndGoWithoutATrace) {
    shell(fmt::format("cpack --config '{}/CPackConfig.cmake' -B packages -D "
                      "CPACK_DEBIAN_COMPRESSION_TYPE=gzip >log "
                      "2>&1 || (cat log; exit 1)",
                      test_support::binary_root()));
    // Two hundred libraries stand behind pictures: they come along unless a user leaves them out.
    EXPECT_THAT(shell("dpkg-deb -f packages/isochron_*.deb Recommends"),
                HasSubstr("libopenimageio"));
    EXPECT_THAT(shell("dpkg-deb -f packages/isochron_*.deb Depends"),
                testing::AllOf(HasSubstr("libegl1"), testing::Not(HasSubstr("libopenimageio"))));
    // FFTW's license is that of one package, and said there.
    EXPECT_EQ(shell("for f in packages/*.deb; do dpkg-deb -f $f Depends | grep -q libfftw && "
                    "dpkg-deb -f $f Package || true; done"),
              "isochron-generate\n");
    EXPECT_THAT(shell("dpkg-deb --fsys-tarfile packages/isochron-generate_*.deb | "
                      "tar -xO ./usr/share/doc/isochron-generate/copyright"),
                HasSubstr("License: GPL-2+"));
    const std::string dpkg =
        "dpkg --root=$PWD/root --force-not-root --force-depends --force-script-chrootless "
        "--log=$PWD/dpkg.log ";
    shell("mkdir -p root/var/lib/dpkg/info root/var/lib/dpkg/updates root/bin root/usr/bin && "
          "touch root/var/lib/dpkg/status root/var/lib/dpkg/available");
    const std::vector<std::string> before = files_below(folder.path() / "root" / "usr");
    shell(dpkg + "--install packages/*.deb >log 2>&1 || (cat log; exit 1)");
    const std::vector<std::string> installed = files_below(folder.path() / "root" / "usr");
    EXPECT_GT(installed.size(), 50u);
    for (const char* file :
         {"bin/isochron", "libexec/isochron/isochron-reader-vtk",
          "share/applications/isochron.desktop", "libexec/isochron/libisochron_images.so",
          "share/mime/packages/isochron.xml", "share/doc/isochron/copyright",
          "libexec/isochron/libisochron_mpi.so", "share/doc/isochron-generate/copyright",
          "share/doc/isochron/third-party/libcli11-dev", "lib/cmake/Isochron/IsochronConfig.cmake"})
        EXPECT_TRUE(fs::exists(folder.path() / "root/usr" / file)) << file;
    EXPECT_THAT(shell("root/usr/bin/isochron --version"), HasSubstr("isochron "));
    const bool python = fs::exists(folder.path() / "root/usr/lib/python3/dist-packages/isochron");
    if (python) { // compiles what it imports, beside it
        EXPECT_EQ(shell("PYTHONPATH=root/usr/lib/python3/dist-packages /usr/bin/python3 -c "
                        "'import isochron; print(isochron.__name__)'"),
                  "isochron\n");
    }
    shell(dpkg +
          "--purge isochron isochron-readers-vtk isochron-mpi isochron-generate libisochron-dev " +
          (python ? "python3-isochron" : "") + " >log 2>&1 || (cat log; exit 1)");
    EXPECT_EQ(files_below(folder.path() / "root" / "usr"), before);
}

} // namespace
} // namespace isochron::app
