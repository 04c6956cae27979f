// `isochron table`: what a session marked, and how long its frames took.
#include "tests/app/commands/command_line.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

namespace isochron::app {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class TableCommand : public CommandLine {
  protected:
    std::string table_of(const std::vector<std::string>& more) {
        std::vector<std::string> all{"table"};
        all.insert(all.end(), more.begin(), more.end());
        const ChildResult result = isochron(all);
        EXPECT_EQ(result.status, 0) << result.err;
        return result.out;
    }
};

constexpr const char* kWalk =
    R"({"format":"isochron recording","version":1,"program":"isochron","configuration":"desktop","data":"a.isochron","data_hash":"0","start":{"isovalue":1}}
{"t":0.5,"devices":[]}
{"t":1.5,"commands":{"step":3,"mark":{"position":[1,2.5,-3],"step":3,"value":9.25}}}
{"t":1.75,"commands":{"mark":{"position":[1,2.5,-3],"step":3,"value":9.5,"fraction":16384}}}
{"t":2,"commands":{"ruler":{"places":[[0,0,0],[3,4,0]]},"stamps":["here, \"now\""]}}
{"t":3,"commands":{"bookmarks":[{"name":"late","step":7,"fraction":32768}]}}
{"t":4,"commands":{"bookmarks":[{"name":"late","step":7,"fraction":32768},{"name":"early","step":1}]}}
)";

TEST_F(TableCommand, MarksOfARecordingAreRowsInTheOrderOfTime) {
    folder.write("walk.jsonl", kWalk);
    EXPECT_EQ(table_of({"walk.jsonl"}), "what,seconds,step,fraction,name,x,y,z,value\n"
                                        "mark,1.5,3,0,,1.0,2.5,-3.0,9.25\n"
                                        "mark,1.75,3,16384,,1.0,2.5,-3.0,9.5\n"
                                        "ruler,2.0,3,0,1,0.0,0.0,0.0,\n"
                                        "ruler,2.0,3,0,1,3.0,4.0,0.0,5.0\n"
                                        "stamp,2.0,3,0,\"here, \"\"now\"\"\",,,,\n"
                                        "bookmark,3.0,7,32768,late,,,,\n"
                                        "bookmark,4.0,1,0,early,,,,\n");
    const auto rows = nlohmann::json::parse(table_of({"walk.jsonl", "--json"}));
    ASSERT_EQ(rows.size(), 7u);
    EXPECT_EQ(rows[3].at("value"), 5.0);
    EXPECT_EQ(rows[4].at("name"), "here, \"now\"");
}

TEST_F(TableCommand, ARecordingThatWasCutShortIsNamedWhereTheWholeOneIsMissing) {
    folder.write("walk.jsonl.part", kWalk);
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"table", "walk.jsonl"},
                                               {"replay", "walk.jsonl", "--stamps", "-o", "p"},
                                               {"movie", "walk.jsonl", "-o", "m.mp4"}}) {
        const ChildResult result = isochron(words);
        EXPECT_EQ(result.status, 1) << words[0];
        EXPECT_THAT(result.err, HasSubstr("walk.jsonl: there is no such file, but walk.jsonl.part: "
                                          "a recording that was cut short"))
            << words[0];
    }
    EXPECT_EQ(table_of({"walk.jsonl.part"}).substr(0, 5), "what,");
}

TEST_F(TableCommand, EachRulerOfAListHasItsRowsOnceAndAnAngleItsDegrees) {
    folder.write(
        "walk.jsonl",
        std::string(kWalk) +
            R"({"t":5,"commands":{"rulers":{"picked":2,"angle":true,"list":[)"
            R"({"name":"1","places":[[0,0,0],[3,4,0]],"angle":false,"shown":true},)"
            R"({"name":"bend","places":[[2,0,0],[0,0,0],[0,0,5]],"angle":true,"shown":true},)"
            R"({"name":"3","places":[[2,0,0]],"angle":true,"shown":true}]}}})"
            "\n");
    EXPECT_THAT(table_of({"walk.jsonl"}),
                testing::EndsWith("early,,,,\n"
                                  "ruler,5.0,3,0,bend,2.0,0.0,0.0,\n"
                                  "ruler,5.0,3,0,bend,0.0,0.0,0.0,\n"
                                  "ruler,5.0,3,0,bend,0.0,0.0,5.0,90.0\n"));
}

TEST_F(TableCommand, ARecordingIsKnownHoweverLongItsConfigurationIs) {
    std::ifstream shipped(test_support::source_root() + "/configs/demo.jsonl");
    std::ostringstream text;
    text << shipped.rdbuf();
    folder.write("demo.jsonl", text.str());
    EXPECT_THAT(table_of({"demo.jsonl"}), HasSubstr("\nstamp,"));
}

TEST_F(TableCommand, ATimingReportHasARowForEachFrame) {
    folder.write("frames.json",
                 R"({"program":"isochron","rows":[{"t":0,"asked":{"step":1,"isovalue":2.5}},
                     {"t":0.1,"asked":{"step":2},"late":"draw"}],"frames":2})");
    EXPECT_EQ(table_of({"frames.json"}), "t,asked.step,asked.isovalue,late\n"
                                         "0,1,2.5,\n"
                                         "0.1,2,,draw\n");
    EXPECT_THAT(table_of({"frames.json", "-o", "frames.csv"}), StartsWith("wrote frames.csv: 2"));
    EXPECT_THAT(folder.read("frames.csv"), StartsWith("t,asked.step"));
}

TEST_F(TableCommand, NoTextIsAFormulaOfASpreadsheetUnlessItIsAskedFor) {
    folder.write("frames.json",
                 R"({"program":"isochron","rows":[{"=k":-1,"a":"=1+1","b":"+1","c":"-1",
        "d":"@x","e":"\t=1","f":"\r=1","g":"x=1","h":-2.5,"i":"a;=1","j":"'"}]})");
    EXPECT_EQ(table_of({"frames.json"}),
              "'=k,a,b,c,d,e,f,g,h,i,j\n"
              "-1,'=1+1,'+1,'-1,'@x,\\t=1,\\x0d=1,x=1,-2.5,\"a;=1\",'\n");
    EXPECT_EQ(table_of({"frames.json", "--keep-formulas"}),
              "=k,a,b,c,d,e,f,g,h,i,j\n"
              "-1,=1+1,+1,-1,@x,\\t=1,\\x0d=1,x=1,-2.5,\"a;=1\",'\n");
}

TEST_F(TableCommand, WhatIsNeitherIsRefusedInALine) {
    folder.write("other.json", "{\"a\":1}");
    folder.write("broken.json", "{\"a\":");
    for (const auto& [name, said] : {std::pair("other.json", "expected a recording, a session or"),
                                     std::pair("broken.json", "not JSON at byte"),
                                     std::pair("missing.json", "there is no such file")}) {
        const ChildResult result = isochron({"table", name});
        EXPECT_EQ(result.status, 1);
        EXPECT_THAT(result.err, HasSubstr(said)) << name;
        EXPECT_EQ(result.out, "");
    }
}

} // namespace
} // namespace isochron::app
