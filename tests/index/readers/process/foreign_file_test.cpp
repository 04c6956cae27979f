// Files in reader processes: crashes, kills, hangs and too much memory give one error line, and the
// next file is read.
#include "index/readers/formats/foreign_file.h"

#include "index/readers/process/file_fence.h"
#include "index/readers/process/process_signs.h"
#include "index/readers/process/process_text.h"
#include "index/readers/process/readable_places.h"
#include "tests/support/eventually.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <future>

namespace isochron::index {
namespace {

using test_support::eventually;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(test_support::test_data()) / "vti";

/// Readers that this process has started, by their names in /proc.
std::vector<pid_t> running_readers(pid_t parent = ::getpid()) {
    std::vector<pid_t> found;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        std::ifstream status(entry.path() / "status"); // ends early with its process
        std::string name, key;
        pid_t of = 0;
        char state = 0;
        for (std::string line; std::getline(status, line);) {
            std::istringstream fields(line);
            fields >> key;
            if (key == "Name:")
                fields >> name;
            else if (key == "State:")
                fields >> state;
            else if (key == "PPid:")
                fields >> of;
        }
        if (name.starts_with("isochron-reader") && of == parent && state != 'Z')
            found.push_back(std::stoi(entry.path().filename().string()));
    }
    return found;
}

std::unique_ptr<VolumeFile> open_in(ReaderPool& pool, const fs::path& file) {
    return open_foreign(pool, format_named("vti"), file, {});
}

std::vector<std::int16_t> values_in(VolumeFile& file) {
    std::vector<std::int16_t> values(file.info().step_bytes() / 2);
    file.read(0, std::as_writable_bytes(std::span(values)));
    return values;
}

void expect_good(VolumeFile& file) {
    auto expected = ramp<std::int16_t>(60);
    for (std::int16_t& v : expected)
        v = static_cast<std::int16_t>(v * 7 - 100);
    EXPECT_EQ(values_in(file), expected);
}

#ifdef ISOCHRON_SANITIZED // which ends the reader itself
constexpr const char* kCrash = "ended with status";
#else
constexpr const char* kCrash = "crashed on it (SIGSEGV)";
#endif

TEST(ForeignFile, ThatCrashesItsReaderIsOneLineAndTheNextIsRead) {
    ReaderPool pool;
    TestFolder folder;
    for (const char* type : {"7", "", ".", "foo"}) { // VTK reads rectilinear grids
        const fs::path file = folder.path() / "field_type.vtr";
        folder.write("field_type.vtr", fmt::format(R"(<VTKFile type="RectilinearGrid" version="0.1">
<RectilinearGrid WholeExtent="0 1 0 1 0 1"><FieldData>
<DataArray type="{}" Name="TimeValue" NumberOfTuples="1" format="ascii">1</DataArray>
</FieldData></RectilinearGrid></VTKFile>)",
                                                   type));
        EXPECT_THAT(
            error_of([&] { values_in(*open_foreign(pool, format_named("vtk data"), file, {})); }),
            AllOf(StartsWith(file.string() + ": cannot be read: its reader "), HasSubstr(kCrash)))
            << type;
        expect_good(*open_in(pool, kFolder / "raw_zlib64.vti"));
    }
}

TEST(ForeignFile, OfWhichVtkMakesACrashIsRefusedInOneLineByTheReaderOfItsOwn) {
    ReaderPool pool;
    for (const char* name : {"field_type_number.vti", "field_type_blank.vti", "field_type_dot.vti",
                             "field_type_foo.vti", "field_offset_fraction.vti"}) {
        const fs::path file = fs::path(test_support::test_data()) / "damaged" / name;
        EXPECT_THAT(error_of([&] { values_in(*open_in(pool, file)); }),
                    AllOf(StartsWith(file.string() + ": "), HasSubstr("array TimeValue"),
                          HasSubstr(", expected "), testing::Not(HasSubstr("its reader"))));
        expect_good(*open_in(pool, kFolder / "raw_zlib64.vti"));
    }
}

TEST(ForeignFile, WhoseReaderIsKilledIsOneLine) {
    ReaderPool pool;
    const auto file = open_in(pool, kFolder / "ascii.vti");
    ASSERT_EQ(running_readers().size(), 1u);
    ::kill(running_readers().front(), SIGKILL);
    EXPECT_THAT(error_of([&] { values_in(*file); }),
                AllOf(HasSubstr("ascii.vti: cannot be read: its reader was killed (SIGKILL)")));
    EXPECT_TRUE(running_readers().empty());
    expect_good(*file); // in another
}

TEST(ForeignFile, WhoseNameHasControlCharactersIsRefusedInOneLine) {
    ReaderPool pool;
    TestFolder folder;
    folder.write("a\nb.vti", "<VTKFile>");
    EXPECT_THAT(error_of([&] { open_in(pool, folder.path() / "a\nb.vti"); }),
                AllOf(HasSubstr("a b.vti"), testing::Not(HasSubstr("\n"))));
}

// What an earlier file has done to a reader is no fault of this one.
TEST(ForeignFile, IsReadAgainWhereItsReaderHadSeenOthers) {
    ReaderPool pool;
    open_in(pool, kFolder / "ascii.vti");
    const auto file = open_in(pool, kFolder / "raw_zlib64.vti");
    const pid_t first = running_readers().at(0);
    ::kill(first, SIGKILL);
    expect_good(*file);
    EXPECT_NE(running_readers().at(0), first);
    // Also when it died while nobody used it.
    ReaderPool idle;
    open_in(idle, kFolder / "ascii.vti");
    for (const pid_t reader : running_readers())
        ::kill(reader, SIGKILL);
    expect_good(*open_in(idle, kFolder / "ascii.vti"));
}

TEST(ForeignFile, WhoseReaderHangsIsOneLine) {
    ReaderPool pool({.patience = std::chrono::milliseconds(300)});
    std::unique_ptr<VolumeFile> file;
    // On a busy machine a reader may get no processor for so long: then it is another's turn.
    ASSERT_TRUE(eventually([&] {
        try {
            file = open_in(pool, kFolder / "ascii.vti");
        } catch (const Error&) {
        }
        return file != nullptr;
    }));
    ::kill(running_readers().at(0), SIGSTOP);
    EXPECT_THAT(error_of([&] { values_in(*file); }),
                EndsWith("ascii.vti: cannot be read: its reader made no progress for 0.3 s and was "
                         "stopped"));
    EXPECT_TRUE(running_readers().empty());
    ReaderPool patient;
    expect_good(*open_in(patient, kFolder / "ascii.vti"));
}

/// Legacy VTK with so many bytes of values.
fs::path large_file(const TestFolder& folder, std::size_t slices) {
    std::string text = fmt::format("# vtk DataFile Version 3.0\nlarge\nBINARY\nDATASET "
                                   "STRUCTURED_POINTS\nDIMENSIONS 256 256 {0}\nORIGIN 0 0 0\n"
                                   "SPACING 1 1 1\nPOINT_DATA {1}\nSCALARS v unsigned_char\n"
                                   "LOOKUP_TABLE default\n",
                                   slices, slices * 65536);
    for (std::size_t i = 0; i < slices * 65536; ++i)
        text += static_cast<char>(i * 31 / 65536 + i);
    return folder.write("large.vtk", text + "\n");
}

TEST(ForeignFile, IsReadInSlabs) {
    TestFolder folder;
    constexpr std::size_t kSlices = 70; // several slabs, and a last one of another size
    ReaderPool pool;
    const auto file = open_foreign(pool, format_named("vtk"), large_file(folder, kSlices), {});
    std::vector<std::uint8_t> values(kSlices * 65536), expected(values.size());
    file->read(0, std::as_writable_bytes(std::span(values)));
    for (std::size_t i = 0; i < values.size(); ++i)
        expected[i] = static_cast<std::uint8_t>(i * 31 / 65536 + i);
    EXPECT_TRUE(values == expected);
}

#ifndef ISOCHRON_SANITIZED // whose own memory a limit would count
TEST(ForeignFile, WhoseReaderWantsTooMuchMemoryIsOneLine) {
    TestFolder folder;
    ReaderPool pool({.memory = 4 << 20});
    const fs::path file = large_file(folder, 200);
    EXPECT_THAT(error_of([&] { open_foreign(pool, format_named("vtk"), file, {}); }),
                StartsWith(file.string() + ": cannot be read: "));
    expect_good(*open_in(pool, kFolder / "ascii.vti"));
}

TEST(Readers, AreFencedIn) {
    ReaderPool pool;
    const auto file = open_in(pool, kFolder / "ascii.vti");
    const std::string status = read_file(fmt::format("/proc/{}/status", running_readers().at(0)));
    EXPECT_THAT(status, AllOf(HasSubstr("NoNewPrivs:\t1"), HasSubstr("Seccomp:\t2")));
}

TEST(Readers, SeeOnlyTheFoldersOfTheirFiles) {
    ASSERT_GE(file_fence_version(), 1) << "this kernel has no Landlock";
    ReaderPool pool;
    const TestFolder here, elsewhere;
    for (const TestFolder* each : {&here, &elsewhere})
        fs::copy_file(kFolder / "ascii.vti", each->path() / "a.vti");
    expect_good(*open_in(pool, here.path() / "a.vti"));
    EXPECT_TRUE(pool.may_read(here.path() / "other"));
    EXPECT_FALSE(pool.may_read(elsewhere.path() / "a.vti"));
    // A reader that was started for one folder is no use in the other.
    const auto old = pool.take("isochron-reader-vti");
    old->ask(OpenFile{.format = "vti", .path = elsewhere.path() / "a.vti", .options = {}});
    const ReaderReply reply = old->reply();
    const auto* refused = std::get_if<Refused>(&reply);
    ASSERT_TRUE(refused);
    EXPECT_THAT(refused->message, HasSubstr("--allow " + elsewhere.path().string()));
    expect_good(*open_in(pool, elsewhere.path() / "a.vti")); // in another
    fs::remove_all(here.path() / "a.vti");
    fs::create_symlink(elsewhere.path() / "a.vti", here.path() / "link.vti");
    expect_good(*open_in(pool, here.path() / "link.vti"));
}

/// From now on this process and those that it starts cannot make this system call.
bool refuse_call(unsigned number, unsigned error) {
    std::array<sock_filter, 4> code{{
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    }};
    const sock_fprog program{code.size(), code.data()};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

TEST(Readers, ReadNothingWhereTheyCannotBeFencedInAndSayWhatIsRefused) {
    constexpr unsigned kLandlockRestrictSelf = 446; // on all machines
    std::vector<std::tuple<unsigned, unsigned, std::string>> refusals{
        {__NR_seccomp, ENOSYS, "its list of system calls (seccomp)"}};
    if (file_fence_version() > 0)
        refusals.emplace_back(kLandlockRestrictSelf, EPERM, "to hide files from it (Landlock)");
    for (const auto& [call, error, said] : refusals) {
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            [&]() noexcept {
                EXPECT_TRUE(refuse_call(call, error));
                ReaderPool pool;
                for (int round = 0; round < 2; ++round)
                    EXPECT_THAT(error_of([&] { open_in(pool, kFolder / "ascii.vti"); }),
                                EndsWith("ascii.vti: cannot be read: its reader cannot be fenced "
                                         "in: the system refuses " +
                                         said));
                EXPECT_TRUE(running_readers().empty());
            }();
            ::_exit(testing::Test::HasFailure() ? 1 : 0);
        }
        int status = -1;
        ::waitpid(child, &status, 0);
        EXPECT_EQ(status, 0) << said;
    }
}
#endif

TEST(Readers, AreAsManyAsFilesThatAreOpenAtATime) {
    ReaderPool pool;
    for (int round = 0; round < 3; ++round) {
        std::vector<std::unique_ptr<VolumeFile>> files;
        for (int i = 0; i < 3; ++i)
            files.push_back(open_in(pool, kFolder / "raw_zlib64.vti"));
        for (const auto& file : files)
            expect_good(*file);
        EXPECT_EQ(running_readers().size(), 3u);
    }
}

TEST(Readers, WorkForSeveralThreads) {
    ReaderPool pool;
    std::vector<std::future<void>> threads;
    for (const char* name : {"ascii.vti", "raw_zlib64.vti", "base64_lz432.vti"})
        threads.push_back(std::async(std::launch::async, [&pool, name] {
            for (int i = 0; i < 20; ++i)
                expect_good(*open_in(pool, kFolder / name));
        }));
    for (auto& thread : threads)
        thread.get();
}

TEST(Readers, EndWithTheProgramHoweverItEnds) {
    std::array<int, 2> told{};
    ASSERT_EQ(::pipe(told.data()), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        [&]() noexcept { // an Error would go on with the next tests
            ReaderPool pool;
            const auto file = open_in(pool, kFolder / "ascii.vti");
            const pid_t reader = running_readers().at(0);
            const bool good = ::write(told[1], &reader, sizeof reader) == ssize_t{sizeof reader};
            ::kill(good ? ::getpid() : 0, SIGKILL);
        }();
    }
    ::close(told[1]); // else the wait has no end where the child tells nothing
    pid_t reader = 0;
    ASSERT_EQ(::read(told[0], &reader, sizeof reader), ssize_t{sizeof reader});
    ::waitpid(child, nullptr, 0);
    EXPECT_TRUE(eventually([&] {
        const std::string stat = process_text(fmt::format("/proc/{}/stat", reader));
        return stat.empty() || stat.find(") Z") != stat.npos;
    }));
    ::close(told[0]);
}

TEST(Readers, AreNotSharedWithAForkOfTheirProcess) {
    auto pool = std::make_unique<ReaderPool>();
    auto file = open_in(*pool, kFolder / "ascii.vti");
    expect_good(*open_in(*pool, kFolder / "raw_zlib64.vti")); // whose reader is idle then
    const std::vector<pid_t> readers = running_readers();
    ASSERT_EQ(readers.size(), 2u);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        ::alarm(std::chrono::seconds(test_support::kPatience).count()); // rather than wait for ever
        [&]() noexcept {
            expect_good(*file);
            expect_good(*open_in(*pool, kFolder / "raw_zlib64.vti"));
            file.reset();
            pool.reset();
        }();
        ::_exit(testing::Test::HasFailure() ? 1 : 0);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(running_readers(), readers);
    expect_good(*file);
}

TEST(ReadablePlaces, KnowAFolderMadeAnewThoughItHasTheNumberOfTheOldOne) {
    TestFolder folder;
    const fs::path place = folder.path() / "series";
    ReadablePlaces places;
    for (int round = 0; round < 20; ++round) { // file systems give some numbers again at once
        fs::create_directory(place);
        EXPECT_FALSE(places.contain(place / "step")) << "the fences of readers know the old one";
        const std::uint64_t before = places.age();
        places.add(place);
        EXPECT_GT(places.age(), before);
        EXPECT_TRUE(places.contain(place / "step"));
        fs::remove(place);
    }
}

TEST(ProcessSigns, GrowWithWhatAProcessReadsAndTouches) {
    const auto before = signs_of(::getpid());
    ASSERT_TRUE(before);
    read_file(kFolder / "ascii.vti");
    std::vector<char> touched(10 << 20, 1);
    const auto after = signs_of(::getpid());
    ASSERT_TRUE(after);
    EXPECT_GE(after->read, before->read + fs::file_size(kFolder / "ascii.vti"));
    EXPECT_GT(after->touched, before->touched);
    EXPECT_FALSE(after->waits_for_disk);
    EXPECT_FALSE(signs_of(-5));
}

} // namespace
} // namespace isochron::index
