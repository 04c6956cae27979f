// Texts and names of files, as commands print them.
#include "tests/app/commands/command_line.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace isochron::app {
namespace {

using testing::HasSubstr;

using PrintedTexts = CommandLine;

TEST_F(PrintedTexts, CannotCommandTheTerminal) {
    folder.write("e.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n"
                           "space units: \"m\033[31m\" \"m\x07\" \"\xc2\x9b m\"\n\n12345678");
    folder.write("c.toml", "version = 1\n[[windows]]\nname = \"w\\u001b[31m\\u009bx\"\n");
    folder.write("d.toml", "version = 1\n[osc]\n[[osc.devices]]\nname = \"d\\u001b[31m\\u009bx\"\n"
                           "source = \"s\"\n");
    folder.write(
        "r.jsonl",
        "{\"format\":\"isochron recording\",\"version\":1,\"program\":\"\",\"configuration\":"
        "\"version = 1\\n\",\"data\":\"\",\"data_hash\":\"\",\"start\":{\"bookmarks\":[{\"name\":"
        "\"b\\u001b[31m\\u009bx\",\"step\":1,\"fraction\":0}]}}\n{\"t\":0}\n");
    folder.write("x.pvx", "<pvx><Process Type=\"server\"><Machine Name=\"m&#x9b;31m\" LowerLeft="
                          "\"-1 -1 -1\" LowerRight=\"1 -1 -1\" UpperRight=\"1 1 -1\"/></Process>"
                          "</pvx>");
    const std::string name = "n\033[31m\xc2\x9bx.isochron";
    ASSERT_EQ(isochron({"build", "e.nrrd", "-o", name}).status, 0);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"info", "e.nrrd"},
          {"info", "e.nrrd", "--json"},
          {"info", name},
          {"info", name, "--json"},
          {"verify", name},
          {"export", name, "--isovalue", "50.5", "-o", "\033[31m.ply"},
          {"explore", "--check-config", "c.toml"},
          {"explore", "--list-devices", "--config", "d.toml"},
          {"table", "r.jsonl"},
          {"table", "r.jsonl", "--json"},
          {"config", "import", "x.pvx"}}) {
        const ChildResult result = isochron(command);
        EXPECT_EQ(result.status, 0) << result.err;
        const std::string all = result.out + result.err;
        EXPECT_THAT(all, HasSubstr("31m")) << "what the file says is there";
        for (const char* control : {"\033", "\x07", "\xc2\x9b"})
            EXPECT_THAT(all, testing::Not(HasSubstr(control))) << command[0];
    }
    EXPECT_THAT(isochron({"info", "e.nrrd"}).out, HasSubstr("\\x1b[31m"));
    // What reads JSON gets the name as it is.
    EXPECT_EQ(nlohmann::json::parse(isochron({"info", name, "--json"}).out).at("file"), name);
}

} // namespace
} // namespace isochron::app
