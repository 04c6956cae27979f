// The order of steps by the times that files state, steps that a restart left twice, and some of the steps.
#include "index/readers/formats/open_series.h"
#include "index/readers/formats/series/step_order.h"
#include "tests/support/reader_fixtures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::size_t> files_of(const OrderedSteps& ordered) {
    std::vector<std::size_t> files;
    for (const StepPlace& step : ordered.steps)
        files.push_back(step.file);
    return files;
}

const std::vector<std::string> kThree{"a", "b", "c"};

TEST(StepOrder, IsThatOfTimesNotOfNames) {
    const OrderedSteps ordered = ordered_by_time({{0, 0, 2}, {1, 0, 1}, {2, 0, 3}}, kThree, false);
    EXPECT_THAT(files_of(ordered), ElementsAre(1, 0, 2));
    EXPECT_THAT(ordered.files, ElementsAre(1, 0, 2));
    EXPECT_THAT(ordered.notes, ElementsAre(AllOf(HasSubstr("not of their names"),
                                                 HasSubstr("b (1) before a (2)"))));
    EXPECT_THAT(ordered_by_time({{0, 0, 1}, {1, 0, 2}, {2, 0, 3}}, kThree, false).notes, IsEmpty());
}

TEST(StepOrder, OfOverlappingFilesIsThatOfTheOneThatBeginsLater) {
    const std::vector<StepPlace> steps{{0, 0, 2}, {0, 1, 3}, {1, 0, 0}, {1, 1, 1}, {1, 2, 2}};
    const std::vector<std::string> names{"a", "b"};
    const OrderedSteps later = ordered_by_time(steps, names, false);
    EXPECT_THAT(files_of(later), ElementsAre(1, 1, 0, 0)) << "a begins later, whatever its name";
    EXPECT_THAT(later.notes, Contains(AllOf(HasSubstr("1 of the times is stated again"),
                                            HasSubstr("later one counts"))));
    EXPECT_THAT(files_of(ordered_by_time(steps, names, true)), ElementsAre(1, 1, 1, 0));
}

TEST(StepOrder, WithinAFileIsThatOfItsTimesToo) {
    const OrderedSteps ordered =
        ordered_by_time({{0, 0, 0}, {0, 1, 1}, {0, 2, 2}, {0, 3, 1}, {0, 4, 2}}, {{"a"}}, false);
    ASSERT_EQ(ordered.steps.size(), 3u);
    EXPECT_EQ(ordered.steps[1].step, 3u);
    EXPECT_EQ(ordered.steps[2].step, 4u);
    EXPECT_THAT(ordered.notes, Contains(HasSubstr("2 of the times are stated again")));
}

TEST(StepOrder, OfAListKeepsItsParts) {
    std::vector<std::string> notes;
    const ListedFiles files = ordered_entries(
        {{"b0", 1, "0"}, {"b1", 1, "1"}, {"a0", 0, "0"}, {"a1", 0, "1"}}, false, notes);
    ASSERT_EQ(files.size(), 4u);
    EXPECT_EQ(files.front().path, "a0");
    EXPECT_THAT(notes, IsEmpty());
}

/// Images of 2 x 2 x 2 vertices of one value, with the time that they state.
class TimedFiles : public testing::Test {
  protected:
    fs::path write(const std::string& name, int value, double time) {
        return folder_.write(
            name,
            fmt::format(
                "<VTKFile type='ImageData' byte_order='LittleEndian'><ImageData WholeExtent='0 1 0 "
                "1 "
                "0 1' Origin='0 0 0' Spacing='1 1 1'><FieldData><DataArray type='Float64' "
                "Name='TimeValue' NumberOfTuples='1' "
                "format='ascii'>{0}</DataArray></FieldData><Piece "
                "Extent='0 1 0 1 0 1'><PointData><DataArray type='UInt8' Name='v' "
                "format='ascii'>{1} {1} {1} {1} {1} {1} {1} {1}</DataArray></PointData></Piece>"
                "</ImageData></VTKFile>",
                time, value));
    }
    std::vector<int> values(const std::vector<fs::path>& files, const ReadOptions& options = {}) {
        const auto series = open_series(files, options);
        std::vector<int> all;
        for (std::size_t step = 0; step < series->info().steps(); ++step)
            all.push_back(values_of<std::uint8_t>(*series, step).front());
        return all;
    }

    TestFolder folder_;
};

TEST_F(TimedFiles, AreInTheOrderOfTheirTimes) {
    const std::vector<fs::path> files{write("jan.vti", 1, 1), write("feb.vti", 2, 2),
                                      write("mar.vti", 3, 3)};
    EXPECT_THAT(values(files), ElementsAre(1, 2, 3));
    const auto series = open_series(files);
    EXPECT_THAT(series->info().times, ElementsAre(1, 2, 3));
    EXPECT_THAT(series->info().sources, ElementsAre("jan.vti", "feb.vti", "mar.vti"));
    EXPECT_THAT(series->info().notes, Contains(HasSubstr("are read as months")));
    EXPECT_THAT(open_series({write("late.vti", 1, 1), write("early.vti", 2, 2)})->info().notes,
                Contains(HasSubstr("not of their names")));
}

TEST_F(TimedFiles, OfTheSameTimeCountOnce) {
    const std::vector<fs::path> files{write("a_0.vti", 1, 0), write("a_1.vti", 2, 1),
                                      write("b_1.vti", 3, 1), write("b_2.vti", 4, 2)};
    EXPECT_THAT(values(files), ElementsAre(1, 3, 4));
    ReadOptions first;
    first.keep_first = true;
    EXPECT_THAT(values(files, first), ElementsAre(1, 2, 4));
}

// An advice is followed here.
TEST_F(TimedFiles, AllOfOneTimeAreSpacedAsTheErrorAdvises) {
    const std::vector<fs::path> files{write("t_0.25.vti", 1, 7), write("t_0.5.vti", 2, 7)};
    EXPECT_THAT(error_of([&] { open_series(files); }),
                AllOf(HasSubstr("t_0.5.vti: time 7"), HasSubstr("--time-step")));
    ReadOptions options;
    options.time_step = 0.25;
    EXPECT_THAT(values(files, options), ElementsAre(1, 2));
}

TEST_F(TimedFiles, NamedTwiceByACollectionForATimeCountOnce) {
    write("a.vti", 1, 0), write("b.vti", 2, 0);
    const auto collection = [&](const std::string& first, const std::string& second) {
        return folder_.write("s.pvd",
                             "<VTKFile type='Collection'><Collection><DataSet timestep='1' "
                             "part='0' file='" +
                                 first + "'/><DataSet timestep='1' part='0' file='" + second +
                                 "'/></Collection></VTKFile>");
    };
    const fs::path twice = collection("a.vti", "b.vti");
    EXPECT_THAT(values({twice}), ElementsAre(2));
    EXPECT_THAT(open_series({twice})->info().notes,
                Contains(AllOf(HasSubstr("1 of the times"), HasSubstr("a.vti and b.vti"),
                               HasSubstr("later one counts"))));
    ReadOptions first;
    first.keep_first = true;
    EXPECT_THAT(values({twice}, first), ElementsAre(1));
    EXPECT_THAT(values({collection("a.vti", "a.vti")}), ElementsAre(1));
}

TEST_F(TimedFiles, MayBeReadInPart) {
    std::vector<fs::path> files;
    for (int i = 0; i < 8; ++i)
        files.push_back(write(fmt::format("t_{}.vti", i), i, i * 0.5));
    ReadOptions options;
    options.steps = {{1, 7, 3}};
    EXPECT_THAT(values(files, options), ElementsAre(1, 4, 7));
    EXPECT_THAT(open_series(files, options)->info().times, ElementsAre(0.5, 2, 3.5));
    EXPECT_THAT(open_series(files, options)->info().sources,
                ElementsAre("t_1.vti", "t_4.vti", "t_7.vti"));
    options.steps = {{1, 8, 1}};
    EXPECT_THAT(error_of([&] { open_series(files, options); }), HasSubstr("expected steps of 0:7"));
}

TEST_F(TimedFiles, BesideAListAreListedUnlessItNamesThem) {
    fs::create_directories(folder_.path() / "run");
    write("run/a_0.vti", 1, 0), write("run/a_1.vti", 2, 1);
    const auto list = [&](const std::string& second) {
        folder_.write("run/s.pvd", "<VTKFile type='Collection'><Collection><DataSet timestep='0' "
                                   "file='a_0.vti'/><DataSet timestep='1' file='" +
                                       second + "'/></Collection></VTKFile>");
    };
    list("a_1.vti");
    EXPECT_THAT(values({folder_.path()}), ElementsAre(1, 2));
    write("run/a_2.vti", 3, 2);
    EXPECT_THAT(open_series({folder_.path()})->info().notes,
                Contains(AllOf(HasSubstr("s.pvd does not name"), HasSubstr("a_2.vti"))));
    fs::remove(folder_.path() / "run/a_2.vti");
    for (const char* name : {"other_0.vti", "other_1.vti"})
        write(name, 5, 0);
    EXPECT_THAT(error_of([&] { open_series({folder_.path()}); }),
                AllOf(HasSubstr("several series"), HasSubstr("s.pvd'"),
                      HasSubstr("other_*.vti' (2 files)")));
    fs::remove(folder_.path() / "other_0.vti");
    fs::remove(folder_.path() / "other_1.vti");
    list("gone.vti");
    EXPECT_THAT(values({folder_.path()}), ElementsAre(1, 2)) << "a list whose files are gone";
    EXPECT_THAT(open_series({folder_.path()})->info().notes,
                Contains(AllOf(HasSubstr("left out"), HasSubstr("gone.vti is not there"))));
}

TEST_F(TimedFiles, GivenWithTheListThatNamesThemAreTheListAlone) {
    const std::vector<fs::path> files{
        write("a.vti", 1, 0), write("b.vti", 2, 0),
        folder_.write("s.pvd", "<VTKFile type='Collection'><Collection><DataSet timestep='1' "
                               "file='b.vti'/><DataSet timestep='2' file='a.vti'/>"
                               "</Collection></VTKFile>")};
    EXPECT_THAT(values(files), ElementsAre(2, 1));
}

} // namespace
} // namespace isochron::index
