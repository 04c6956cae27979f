// Files with arrays of several shapes: what is offered, and what a choice leads to.
#include "app/indexing/array_offers.h"

#include "app/indexing/build_sources.h"
#include "app/indexing/indexing.h"
#include "index/file/index_file.h"
#include "tests/support/eventually.h"
#include "tests/support/test_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstring>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// A group in Zarr with two arrays of one shape and a smaller one.
class ArrayOffers : public testing::Test {
  protected:
    ArrayOffers() {
        fs::create_directory(folder_.path() / "run.zarr");
        folder_.write("run.zarr/.zgroup", R"({"zarr_format":2})");
        add("heat", 6);
        add("rho", 6);
        add("speed", 4);
        arguments_.read.value_unit = "K";
        arguments_.files = {(folder_.path() / "run.zarr").string()};
        files_ = {folder_.path() / "run.zarr"};
    }
    /// Values 0, 1, 2 and so on.
    void add(const std::string& name, int size) const {
        fs::create_directory(folder_.path() / "run.zarr" / name);
        folder_.write("run.zarr/" + name + "/.zarray",
                      fmt::format(R"({{"zarr_format":2,"shape":[{0},{0},{0}],"chunks":[{0},{0},{0}],
            "dtype":"<f4","compressor":null,"fill_value":0,"order":"C","filters":null}})",
                                  size));
        std::string bytes(static_cast<std::size_t>(size * size * size) * sizeof(float), 0);
        for (std::size_t i = 0; i < bytes.size() / sizeof(float); ++i) {
            const auto value = static_cast<float>(i);
            std::memcpy(&bytes[i * sizeof value], &value, sizeof value);
        }
        folder_.write("run.zarr/" + name + "/0.0.0", bytes);
    }

    test_support::TestFolder folder_;
    BuildArguments arguments_;
    std::vector<fs::path> files_;
};

TEST_F(ArrayOffers, HaveShapesUnitsAndRanges) {
    const auto offers = offered_arrays(files_, arguments_);
    std::vector<std::string> words;
    for (const ArrayOffer& each : offers)
        words.push_back(fmt::format("{}|{}|{}|{}|{}", each.name, each.shape, each.unit, each.group,
                                    each.fault.empty()));
    EXPECT_THAT(words, testing::UnorderedElementsAre("heat|6 x 6 x 6, 1 step|K|0|true",
                                                     "rho|6 x 6 x 6, 1 step|K|0|true",
                                                     "speed|4 x 4 x 4, 1 step|K|1|true"));
    EXPECT_EQ(first_range(files_, arguments_, "speed", [] { return true; }),
              (std::array{0.0, 63.0}));
    EXPECT_FALSE(first_range(files_, arguments_, "speed", [] { return false; }));
    fs::remove_all(folder_.path() / "run.zarr/speed");
    EXPECT_TRUE(offered_arrays(files_, arguments_).empty()) << "all that are left go together";
}

TEST_F(ArrayOffers, TheChosenOneIsIndexedWithThoseOfItsShape) {
    for (const auto& [chosen, arrays] :
         {std::pair("speed", std::vector<std::string>{"speed"}),
          std::pair("rho", std::vector<std::string>{"rho", "heat"})}) {
        Indexing indexing(arguments_, folder_.path() / "cache", true);
        ASSERT_TRUE(test_support::eventually([&] { return !indexing.state().offers.empty(); }));
        const auto offers = indexing.state().offers;
        indexing.choose(static_cast<std::size_t>(
            std::ranges::find(offers, chosen, &ArrayOffer::name) - offers.begin()));
        ASSERT_TRUE(test_support::eventually([&] { return indexing.state().done; }));
        indexing.check();
        EXPECT_TRUE(indexing.state().offers.empty());
        std::vector<std::string> names;
        const auto file = index::IndexFile::open(*indexing.state().index);
        for (std::size_t i = 0; i < file->arrays(); ++i)
            names.push_back(file->array(i).info().array);
        EXPECT_EQ(names, arrays);
    }
}

TEST_F(ArrayOffers, NobodyIsAskedWithoutAWindowAndLeavingEndsTheQuestion) {
    Indexing alone(arguments_, folder_.path() / "cache");
    ASSERT_TRUE(test_support::eventually([&] { return alone.state().done; }));
    EXPECT_EQ(index::IndexFile::open(*alone.state().index)->info().array, "heat");
    Indexing asking(arguments_, folder_.path() / "cache", true);
    ASSERT_TRUE(test_support::eventually([&] { return !asking.state().offers.empty(); }));
    EXPECT_FALSE(asking.state().done);
}

} // namespace
} // namespace isochron::app
