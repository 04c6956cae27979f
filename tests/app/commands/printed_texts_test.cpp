// Texts and names of files, as commands print them.
#include "app/safe_text.h"
#include "tests/app/commands/command_line.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// What no output may hold: control characters but line ends, and what changes the direction of text.
std::vector<std::string> forbidden() {
    std::vector<std::string> all;
    for (char c = 1; c < 0x20; ++c)
        if (c != '\n')
            all.emplace_back(1, c);
    all.emplace_back("\x7f");
    for (int c = 0x80; c < 0xa0; ++c)
        all.push_back(std::string("\xc2") + static_cast<char>(c));
    for (const char* each : {"\u061c", "\u200e", "\u200f", "\u2028", "\u2029", "\u202a", "\u202b",
                             "\u202c", "\u202d", "\u202e", "\u2066", "\u2067", "\u2068", "\u2069"})
        all.emplace_back(each);
    return all;
}

void expect_harmless(const std::string& text, const std::string& where) {
    for (const std::string& each : forbidden())
        EXPECT_EQ(text.find(each), text.npos) << where << ": " << json(each).dump(-1, ' ', true);
    EXPECT_NO_THROW(json(text).dump()) << where << ": not UTF-8";
}

TEST(SafeText, SpellsOutWhatTerminalsObeyAndWhatIsNoUtf8AndNothingElse) {
    for (const std::string& each : forbidden()) {
        expect_harmless(one_line("a" + each + "b"), "one_line");
        expect_harmless(SafeText::lines("a" + each + "b").str(), "lines");
        const std::string data = SafeText::data("\"a" + each + "b\"").str();
        expect_harmless(data, "data");
        EXPECT_EQ(json::parse(data), "a" + each + "b");
    }
    for (const char* harmless : {"temp\u00e9rature [\u00b0C]", "\u6e29\u5ea6", "\U0001f30d",
                                 "a\u00a0b", "\u0645\u062f\u0649", "\ufffd", "\U0010ffff"})
        EXPECT_EQ(one_line(harmless), harmless);
    for (const auto& [bytes, safe] : std::vector<std::pair<std::string, std::string>>{
             {"\x9b", "\\x9b"},
             {"a\xff", "a\\xff"},
             {"\xc2", "\\xc2"},
             {"\xc0\x8a", "\\xc0\\x8a"},
             {"\xe0\x80\x8a", "\\xe0\\x80\\x8a"},
             {"\xed\xa0\x80", "\\xed\\xa0\\x80"},
             {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},
             {"\xe2\x80", "\\xe2\\x80"},
             {std::string("\0", 1), "\\x00"},
             {"\n", "\\n"},
             {"\t", "\\t"},
             {"\u202e", "\\u202e"}})
        EXPECT_EQ(one_line(bytes), safe);
    EXPECT_EQ(SafeText::lines("a\nb").str(), "a\nb");
}

TEST(SafeText, OfAVeryLongTextPartsNoCharacter) {
    for (std::size_t shift = 0; shift < 4; ++shift) {
        std::string text(shift, '.');
        for (int i = 0; i < 1000; ++i)
            text += "\U0001f30d";
        EXPECT_EQ(one_line(text).find('\\'), std::string::npos);
        EXPECT_LE(one_line(text).size(), 2100u);
    }
    EXPECT_EQ(one_line(std::string(3000, '\x80')).find('\x80'), std::string::npos);
}

TEST(SafeText, AValueOfAFormatBecomesNoLineOfItsOwn) {
    const std::string name = "a\nisochron: done";
    EXPECT_EQ(SafeText("{}: {} of {:04x} {}\n", name, 7, 255, 0.5).str(),
              "a\\nisochron: done: 7 of 00ff 0.5\n");
    EXPECT_EQ(SafeText("{}{:<4}|{}", SafeText("x\n"), "y", 'z').str(), "x\ny   |z");
    const std::vector<std::string> names{"a\n", "b"};
    EXPECT_EQ(SafeText("{}", fmt::join(names, ", ")).str(), "a\\n, b");
}

class PrintedTexts : public CommandLine {
  protected:
    /// The command's output is harmless, and none of its lines was made by what a file says.
    std::string harmless(const std::vector<std::string>& command, int status = 0,
                         bool says = true) {
        const ChildResult result = isochron(command);
        EXPECT_EQ(result.status, status)
            << fmt::format("{}\n", fmt::join(command, " ")) << result.err;
        const std::string all = result.out + result.err,
                          what = fmt::format("{}", fmt::join(command, " "));
        expect_harmless(all, one_line(what));
        EXPECT_EQ(all.find("\nisochron: forged"), all.npos) << what;
        EXPECT_EQ(all.find("31m") != all.npos, says) << what << "\n" << all;
        if (std::ranges::find(command, "--json") != command.end()) {
            EXPECT_NO_THROW(json_ = json::parse(result.out)) << result.out;
        }
        return all;
    }
    json json_; ///< what a command with `--json` printed last
    const std::string hostile_ = "\033]0;owned\007\u009b31m\u202e\u2066\nisochron: forged";
    const std::string quoted_ =
        R"(\u001b]0;owned\u0007\u009b31m\u202e\u2066\nisochron: forged)"; ///< in JSON and TOML
    const std::string raw_ = "\x9b"; ///< what a terminal of eight bits obeys; no UTF-8
};

TEST_F(PrintedTexts, OfNamesAndUnitsCannotCommandTheTerminal) {
    const std::string file = "n" + hostile_ + raw_;
    folder.write("e.nrrd",
                 "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n"
                 "space units: \"m\033[31m\" \"m\x07\u202e\" \"\u009b m\x9b\"\n\n12345678");
    folder.write(
        "a.vti",
        "<VTKFile type=\"ImageData\" version=\"0.1\"><ImageData WholeExtent=\"0 1 0 1 0 1\">"
        "<Piece Extent=\"0 1 0 1 0 1\"><PointData>"
        "<DataArray type=\"UInt8\" Name=\"a&#x9b;31m&#x202e;\" format=\"ascii\">1 2 3 4 5 6 7 "
        "8</DataArray>"
        "<DataArray type=\"UInt8\" Name=\"b&#x9b;31m&#x202e;\" format=\"ascii\">1 2 3 4 5 6 7 "
        "8</DataArray>"
        "</PointData></Piece></ImageData></VTKFile>");
    const std::string index = file + ".isochron", arrays = "b.isochron";
    const std::string ids = file + ".bin", mesh = file;
    harmless({"build", "e.nrrd", "-o", index});
    harmless({"build", "e.nrrd", "-o", index, "--append"});
    harmless({"build", "a.vti", "-o", "c.isochron"}, 1);
    harmless({"build", "a.vti", "--all-arrays", "-o", arrays});
    for (const auto& more : {std::vector<std::string>{}, {"--json"}}) {
        const auto with = [&](std::vector<std::string> command) {
            command.insert(command.end(), more.begin(), more.end());
            return command;
        };
        harmless(with({"info", "e.nrrd"}));
        harmless(with({"info", "a.vti"}));
        harmless(with({"info", index}));
        harmless(with({"info", arrays}));
        harmless(
            with({"query", index, "--isovalue", "50.5", "--step", "0", "--ids", ids, "--force"}));
        harmless(with({"export", index, "--isovalue", "50.5", "-o", mesh + ".ply", "--force"}));
        harmless(with({"change", index, "--isovalue", "50.5", "--to-isovalue", "51.5", "--step",
                       "0", "--added", ids, "--force"}),
                 0, !more.empty());
    }
    for (const char* suffix : {".stl", ".obj", ".vtp", ".glb", ".usda", ".csv"})
        harmless({"export", index, "--isovalue", "50.5", "-o", mesh + suffix});
    harmless({"verify", index});
    harmless({"query", index, "--isovalue", "1000", "--step", "0"}, 0, false);
    harmless({"query", arrays, "--isovalue", "1", "--step", "0", "--array", "c" + hostile_}, 1);
    harmless({"export", "no" + file, "--isovalue", "1", "-o", "x.ply"}, 1);
    harmless({"generate", "sphere", "--steps", "1", "--out", file});
    harmless({"generate", "s" + hostile_, "--out", "g"}, 2);
    harmless({"s" + hostile_}, 2);
    harmless({"info", "--s" + hostile_}, 2);
    harmless({"reproduce", file, "-o", file + ".png"}, 1);
    EXPECT_THAT(isochron({"info", "e.nrrd"}).out, HasSubstr("\\x1b[31m"));
    // What reads JSON gets the name as it is.
    ASSERT_EQ(isochron({"build", "a.vti", "--all-arrays", "-o", hostile_}).status, 0);
    harmless({"info", hostile_, "--json"});
    EXPECT_EQ(json_.at("file"), hostile_);
    EXPECT_EQ(json_.at("array"), "a\u009b31m\u202e");
}

TEST_F(PrintedTexts, OfConfigurationsAndRecordingsCannotCommandTheTerminal) {
    folder.write("c.toml", "version = 1\n[[windows]]\nname = \"w" + quoted_ + "\"\n");
    folder.write("d.toml", "version = 1\n[osc]\n[[osc.devices]]\nname = \"d" + quoted_ +
                               "\"\nsource = \"s" + quoted_ + "\"\n");
    folder.write("k.toml", "version = 1\n\"k" + quoted_ + "\" = 1\n");
    folder.write("v.toml", "version = 1\n[[viewers]]\nname = \"v" + quoted_ + "\"\nhead = \"h" +
                               quoted_ + "\"\n");
    folder.write(
        "r.jsonl",
        R"({"format":"isochron recording","version":1,"program":"","configuration":"version = 1\n",)"
        R"("data":"","data_hash":"","start":{"bookmarks":[{"name":"b)" +
            quoted_ + R"(","step":1,"fraction":0}]}})" + "\n" +
            R"({"t":0,"commands":{"stamps":["=)" + quoted_ + R"("]}})" + "\n");
    folder.write("f.json",
                 R"({"program":"","rows":[{")" + quoted_ + R"(":1,"a":")" + quoted_ + R"("}]})");
    folder.write("x.pvx",
                 "<pvx><Process Type=\"server\"><Machine Name=\"m&#x9b;31m&#x202e;\" LowerLeft="
                 "\"-1 -1 -1\" LowerRight=\"1 -1 -1\" UpperRight=\"1 1 -1\"/></Process>"
                 "</pvx>");
    for (const char* file : {"c.toml", "d.toml"})
        harmless({"explore", "--check-config", file});
    harmless({"explore", "--check-config", "k.toml"}, 1);
    harmless({"explore", "--check-config", "v.toml"}, 1);
    harmless(as_words("explore --list-devices --config d.toml"));
    for (const char* file : {"r.jsonl", "f.json"}) {
        harmless({"table", file});
        harmless({"table", file, "--json"});
        harmless({"table", file, "--keep-formulas"});
    }
    EXPECT_EQ(isochron({"table", "r.jsonl", "-o", "r.csv"}).status, 0);
    EXPECT_EQ(folder.read("r.csv"), isochron({"table", "r.jsonl"}).out);
    harmless({"config", "import", "x.pvx"});
}

TEST_F(PrintedTexts, OfDamagedJsonAreNoWordsOfItsLibrary) {
    const auto complain = [&](const std::vector<std::string>& command) {
        const ChildResult result = isochron(command);
        const std::string what = fmt::format("{}", fmt::join(command, " "));
        EXPECT_EQ(result.status, 1) << what;
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        for (const char* word : {"json.", "type must", "parse error", "cannot use", "parsing"})
            EXPECT_EQ(result.err.find(word), result.err.npos) << what << ": " << result.err;
        return result.err;
    };
    std::filesystem::create_directory(folder.path() / "a.zarr");
    const auto zarr = [&](const std::string& about, const std::string& attributes) {
        folder.write("a.zarr/.zarray", about);
        folder.write("a.zarr/.zattrs", attributes);
        return complain({"info", "a.zarr"});
    };
    const std::string array = R"({"zarr_format":2,"shape":[2,2,2],"chunks":[2,2,2],"dtype":"|u1",)"
                              R"("compressor":null,"fill_value":0,"order":"C","filters":null)";
    zarr(array, "{}"); // a bracket is missing
    EXPECT_THAT(zarr(array + ",\"chunks\":{}}", "{}"), HasSubstr("expected array, got object"));
    EXPECT_THAT(zarr(array + ",\"compressor\":5}", "{}"), HasSubstr("got number"));
    EXPECT_THAT(zarr("{\"zarr_format\":2}", "{}"), HasSubstr("no "));
    for (const char* attributes :
         {R"({"multiscales":[5]})", R"({"multiscales":[{"axes":5}]})", R"({"omero":5})",
          R"({"multiscales":[{"axes":[{"name":5}],"datasets":5}]})", R"({"omero":{"channels":5}})",
          R"({"multiscales":[{"datasets":[{"path":5}]}],"omero":{"channels":[{"label":5}]}})"})
        zarr("{\"zarr_format\":2}", attributes);
    for (const char* report : {R"({"rows":[{"a":1e999}]})", R"({"rows":[)", R"([1e999])", "5"}) {
        folder.write("t.json", report);
        EXPECT_THAT(complain({"table", "t.json"}), HasSubstr("t.json: "));
    }
    for (const char* state : {"{\"step\":1e999}", "{", "5", "{\"step\":\"x\"}"}) {
        const std::string start =
            R"({"format":"isochron session","version":1,"program":"","data":"",)"
            R"("data_hash":"","head":{"position":[0,0,0],"yaw":0,"pitch":0},)";
        folder.write("s.isochron-session", start + "\"state\":" + state + "}");
        EXPECT_THAT(complain({"table", "s.isochron-session"}), HasSubstr("s.isochron-session: "));
        folder.write("r.jsonl",
                     R"({"format":"isochron recording","version":1,"program":"","data":"",)"
                     R"("configuration":"","data_hash":"","start":)" +
                         std::string(state) + "}\n{\"t\":0}\n");
        EXPECT_THAT(complain({"table", "r.jsonl"}), HasSubstr("r.jsonl:1: "));
    }
}

} // namespace
} // namespace isochron::app
