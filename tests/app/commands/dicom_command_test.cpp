// A folder of DICOM that grows: `build --append` adds the new steps, however the files are called.
#include "tests/app/commands/command_line.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

std::string little(std::uint64_t number, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i)
        text += static_cast<char>(number >> 8 * i & 0xff);
    return text;
}

/// An element of the syntax "explicit VR little endian".
std::string element(unsigned group, unsigned number, const std::string& kind, std::string value) {
    if (value.size() % 2 != 0)
        value += kind == "UI" ? '\0' : ' ';
    const bool wide = kind == "OW";
    return little(group, 2) + little(number, 2) + kind +
           (wide ? little(0, 2) + little(value.size(), 4) : little(value.size(), 2)) + value;
}

class DicomCommand : public CommandLine {
  protected:
    static constexpr std::size_t kSide = 8, kLayers = 4;

    /// One slice at one time, signed 16 bits.
    static std::string slice(int time, int layer) {
        const std::string meta = element(2, 0x02, "UI", "1.2.840.10008.5.1.4.1.1.4") +
                                 element(2, 0x03, "UI", fmt::format("1.2.9.{}.{}", time, layer)) +
                                 element(2, 0x10, "UI", "1.2.840.10008.1.2.1");
        std::string pixels;
        for (std::size_t i = 0; i < kSide * kSide; ++i)
            pixels += little(i * static_cast<std::size_t>(7 + time) + 31u * unsigned(layer), 2);
        return std::string(128, '\0') + "DICM" + element(2, 0, "UL", little(meta.size(), 4)) +
               meta + element(0x08, 0x16, "UI", "1.2.840.10008.5.1.4.1.1.4") +
               element(0x08, 0x18, "UI", fmt::format("1.2.9.{}.{}", time, layer)) +
               element(0x08, 0x60, "CS", "MR") + element(0x20, 0x0e, "UI", "1.2.9") +
               element(0x20, 0x11, "IS", "1") +
               element(0x20, 0x32, "DS", fmt::format("0\\0\\{}", 2 * layer)) +
               element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0") +
               element(0x20, 0x100, "IS", fmt::format("{}", time)) +
               element(0x28, 0x02, "US", little(1, 2)) + element(0x28, 0x04, "CS", "MONOCHROME2") +
               element(0x28, 0x10, "US", little(kSide, 2)) +
               element(0x28, 0x11, "US", little(kSide, 2)) + element(0x28, 0x30, "DS", "1\\1") +
               element(0x28, 0x100, "US", little(16, 2)) +
               element(0x28, 0x101, "US", little(16, 2)) +
               element(0x28, 0x102, "US", little(15, 2)) +
               element(0x28, 0x103, "US", little(1, 2)) + element(0x7fe0, 0x10, "OW", pixels);
    }
    void write_time(int time) {
        fs::create_directories(folder.path() / "scan");
        for (int layer = 0; layer < int(kLayers); ++layer) // later times come first by name
            folder.write(fmt::format("scan/IM{}_{}", 9 - time, (layer * 3) % 4),
                         slice(time, layer));
    }
    std::string found(const std::string& index, int step) {
        const ChildResult result = isochron({"query", index, "--isovalue", "300.5", "--step",
                                             std::to_string(step), "--ids", "ids"});
        EXPECT_EQ(result.status, 0) << result.err;
        return folder.read("ids");
    }
};

TEST_F(DicomCommand, AFolderThatGrowsIsAppended) {
    write_time(1);
    write_time(2);
    ASSERT_EQ(isochron({"build", "scan", "-o", "a.isochron", "--quiet"}).status, 0);
    const std::string first = found("a.isochron", 0);
    ASSERT_FALSE(first.empty());
    write_time(3);
    const ChildResult appended = isochron({"build", "scan", "-o", "a.isochron", "--append"});
    ASSERT_EQ(appended.status, 0) << appended.err;
    ASSERT_EQ(isochron(as_words("build scan -o anew.isochron --quiet")).status, 0);
    const auto said = nlohmann::json::parse(isochron({"info", "a.isochron", "--json"}).out);
    const auto anew = nlohmann::json::parse(isochron({"info", "anew.isochron", "--json"}).out);
    EXPECT_EQ(said.at("times"), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(said.at("content_hash"), anew.at("content_hash"));
    EXPECT_EQ(found("a.isochron", 0), first);
    EXPECT_NE(found("a.isochron", 2), first);
    EXPECT_EQ(found("a.isochron", 2), found("anew.isochron", 2));
    EXPECT_EQ(isochron({"verify", "a.isochron"}).status, 0);
}

TEST_F(DicomCommand, AStepThatWasWrittenToIsNotAppendedTo) {
    write_time(1);
    write_time(2);
    ASSERT_EQ(isochron({"build", "scan", "-o", "a.isochron", "--quiet"}).status, 0);
    const std::string before = folder.read("a.isochron");
    write_time(3);
    folder.write("scan/IM8_0", slice(1, 0).replace(slice(1, 0).size() - 2, 1, "!"));
    expect_failure(isochron(as_words("build scan -o a.isochron --append --quiet")), 1,
                   "a.isochron");
    EXPECT_EQ(folder.read("a.isochron"), before);
}

} // namespace
} // namespace isochron::app
