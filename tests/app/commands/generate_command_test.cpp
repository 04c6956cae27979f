// `isochron generate`: a program of its own makes the series, and its user does not notice.
#include "tests/app/commands/command_line.h"

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

class Generate : public CommandLine {};

TEST_F(Generate, MakesWhatItsOptionsSay) {
    const std::vector<std::string> words{
        "generate", "fourier", "-o",     "a folder", "--size",  "16", "--steps",   "3",
        "--type",   "u8",      "--seed", "7",        "--modes", "5",  "--longest", "4"};
    const ChildResult made = isochron(words);
    EXPECT_EQ(made.status, 0);
    EXPECT_EQ(made.out, "a folder/fourier.pvd: 3 steps\n");
    EXPECT_EQ(made.err, "finding the highest value ...\ncomputing steps ...\n");
    for (const char* said : {R"("size": 16)", R"("steps": 3)", R"("type": "u8")", R"("seed": 7)",
                             R"("modes": 5)", R"("longest": 4)"})
        EXPECT_THAT(folder.read("a folder/fourier.json"), HasSubstr(said));
    const ChildResult again = isochron(words);
    EXPECT_EQ(again.status, 0);
    EXPECT_EQ(again.out, "a folder/fourier.pvd: 3 steps, made before\n");
}

TEST_F(Generate, TellsAsTheProgramDoesWhatIsWrong) {
    EXPECT_EQ(isochron(as_words("generate sphere --out=-d --steps 2")).out,
              "-d/sphere.pvd: 2 steps\n");
    expect_failure(isochron(as_words("generate sphere --out=-d --steps 3")), 1,
                   "-d/sphere.pvd: is another series than ");
    expect_failure(isochron({"generate", "sphere"}), 2,
                   "--output is required (see isochron generate sphere --help)");
    expect_failure(isochron({"generate", "sphere", "-o", "d", "--type", "u9"}), 2,
                   "expected one of f32, u8, got u9, did you mean u8?");
    EXPECT_THAT(isochron({"generate", "sphere", "--help"}).out,
                AllOf(HasSubstr("isochron generate sphere"), HasSubstr("--step-count")));
}

TEST_F(Generate, IsCanceledAsTheProgramIs) {
    const std::vector<std::string> endless =
        as_words("generate fourier -o d --size 64 --steps 100000");
    const ChildResult result = isochron(endless, {.interrupt_after = " ...\n"});
    EXPECT_EQ(result.status, 130);
    EXPECT_THAT(result.err, EndsWith("isochron: canceled\n"));
    EXPECT_FALSE(fs::exists(folder.path() / "d/fourier.pvd"));
}

TEST_F(Generate, NeedsNoFftwInTheProgramItself) {
    const auto libraries_of = [&](const char* program) {
        return run_child("/usr/bin/env",
                         {"LD_TRACE_LOADED_OBJECTS=1", test_support::binary_root() + "/" + program},
                         folder.path())
            .out;
    };
    EXPECT_THAT(libraries_of("isochron"), AllOf(HasSubstr("libstdc++"), Not(HasSubstr("fftw"))));
    EXPECT_THAT(libraries_of("isochron-generate"),
                AllOf(HasSubstr("fftw"), Not(HasSubstr("libEGL")), Not(HasSubstr("glfw"))));
}

TEST_F(Generate, NamesThePackageWhereTheProgramIsAlone) {
    const fs::path bin = folder.path() / "bin";
    fs::create_directory(bin);
    fs::copy_file(test_support::binary_root() + "/isochron", bin / "isochron");
    const auto run = [&](const std::vector<std::string>& words) {
        return run_child((bin / "isochron").string(), words, folder.path());
    };
    expect_failure(run({"generate", "sphere", "-o", "d"}), 1,
                   "isochron-generate: not found beside the program in " + bin.string() +
                       "; `apt install isochron-generate` brings it");
    EXPECT_EQ(run({"generate", "--help"}).status, 0);
    folder.write("bin/isochron-generate", "not to be run");
    expect_failure(run({"generate", "sphere", "-o", "d"}), 1,
                   (bin / "isochron-generate: cannot be started: ").string());
    EXPECT_THAT(folder.names(), Not(Contains("d")));
}

} // namespace
} // namespace isochron::app
