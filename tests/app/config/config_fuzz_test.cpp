// Randomly damaged configurations are read, or refused with a message.
#include "app/config/check_config.h"
#include "app/config/config.h"
#include "app/config/display_config_text.h"
#include "app/config/pvx_file.h"
#include "app/config/shipped_configs.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <sstream>

namespace isochron::app {
namespace {

class Damage {
  public:
    explicit Damage(unsigned seed) : random_(seed) {}

    std::size_t below(std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
    }

    /// The text with a few damages of any kind.
    std::string of(std::string text) {
        for (std::size_t times = 1 + below(3); times > 0 && !text.empty(); --times)
            switch (below(6)) {
            case 0: text[below(text.size())] = static_cast<char>(below(256)); break;
            case 1: text.erase(below(text.size()), 1 + below(40)); break;
            case 2: text.resize(below(text.size())); break;
            case 3:
                text = lines(text, [&](auto& all) { all.erase(all.begin() + below(all.size())); });
                break;
            case 4:
                text = lines(text, [&](auto& all) {
                    const std::string copy = all[below(all.size())];
                    all.insert(all.begin() + below(all.size()), copy);
                });
                break;
            case 5: replace_value(text); break;
            }
        return text;
    }

  private:
    template <typename Change>
    std::string lines(const std::string& text, Change change) {
        std::vector<std::string> all;
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);)
            all.push_back(line);
        if (all.empty())
            return text;
        change(all);
        std::string joined;
        for (const std::string& line : all)
            joined += line + "\n";
        return joined;
    }

    void replace_value(std::string& text) {
        static const std::array<std::string, 16> kValues{
            "0",   "-1",          "1e308",       "nan",
            "inf", "-inf",        "1e-320",      "99999999999999999999",
            "[]",  "[[[[[]]]]]",  "\"\"",        "true",
            "{}",  "\"\\u0000\"", "[nan, 1, 2]", "1979-05-27"};
        const std::size_t equals = text.find('=', below(text.size()));
        if (equals == std::string::npos)
            return;
        const std::size_t end = std::min(text.find('\n', equals), text.size());
        text.replace(equals + 1, end - equals - 1, kValues[below(kValues.size())]);
    }

    std::mt19937 random_;
};

TEST(ConfigFuzz, ADamagedConfigurationIsReadOrRefusedInOneLine) {
    Damage damage(test_seed());
    int read = 0, refused = 0;
    for (const std::string& name : shipped_config_names())
        for (int i = 0; i < tries(1500); ++i) {
            const std::string text = damage.of(*shipped_config(name));
            try {
                const Config config = parse_config(text, "damaged.toml");
                problems_of(config);
                describe(config);
                emulation_for(config);
                // What was accepted can be written, and is then the same.
                ASSERT_EQ(
                    parse_config(display_config_text(config.installation), "again").installation,
                    config.installation)
                    << text;
                ++read;
            } catch (const ConfigError& error) {
                EXPECT_TRUE(std::string_view(error.what()).starts_with("damaged.toml:"))
                    << error.what();
                ++refused;
            }
        }
    EXPECT_GT(read, tries(500)) << "nearly nothing was accepted: is the damage too great?";
    EXPECT_GT(refused, tries(500));
}

TEST(ConfigFuzz, ADamagedPvxFileIsReadOrRefusedInOneLine) {
    const std::string whole = R"(<?xml version="1.0"?>
<pvx><Process Type="server"><EyeSeparation Value="0.065"/>
<IndependentViewers><Viewer Id="0" EyeSeparation="0.06"/></IndependentViewers>
<Machine Name="a" Geometry="800x600+0+0" LowerLeft="-1 -1 -1" LowerRight="1 -1 -1"
 UpperRight="1 1 -1" StereoType="Left" ViewerId="0"/>
<Machine Name="b" LowerLeft="1 -1 -1" LowerRight="1 -1 1" UpperRight="1 1 1"/>
</Process></pvx>
)";
    Damage damage(test_seed());
    const test_support::TestFolder folder;
    int read = 0, refused = 0;
    for (int i = 0; i < tries(2000); ++i) {
        const auto file = folder.write("damaged.pvx", damage.of(whole));
        try {
            read_pvx(file, {});
            ++read;
        } catch (const ConfigError& error) {
            EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
            ++refused;
        }
    }
    EXPECT_GT(read, tries(100));
    EXPECT_GT(refused, tries(100));
}

} // namespace
} // namespace isochron::app
