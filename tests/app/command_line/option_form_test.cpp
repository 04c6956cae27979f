// Options as their forms say: names, and a word for each value.
#include "app/command_line/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace isochron::app {
namespace {

using testing::ElementsAre;

struct Read {
    std::vector<int> size;
    std::string control = "none", out;
};

Read read(const std::vector<std::string>& words) {
    Read read;
    read_words(words, [&](Command& command) {
        command.option("--size PIXELS PIXELS", read.size, "Two values");
        command.option("--control [SOCKET]", read.control, "Maybe a value");
        command.option("-o,--output,--out FILE", read.out, "One value");
    });
    return read;
}

TEST(OptionForms, TakeAValueForEachWord) {
    EXPECT_THAT(read({"--size", "3", "4"}).size, ElementsAre(3, 4));
    EXPECT_THROW(read({"--size", "3"}), UsageError);
    EXPECT_THROW(read({"--size", "3", "4", "5"}), UsageError);
    EXPECT_THROW(read({"--output"}), UsageError);
    for (const char* name : {"-o", "--output", "--out"})
        EXPECT_EQ(read({name, "a.png"}).out, "a.png");
}

TEST(OptionForms, TakeNoValueWhereItStandsInBrackets) {
    EXPECT_EQ(read({"--control", "a.sock"}).control, "a.sock");
    EXPECT_EQ(read({"--control"}).control, "");
    EXPECT_EQ(read({}).control, "none");
}

} // namespace
} // namespace isochron::app
