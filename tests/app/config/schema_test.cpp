// The JSON schema of configurations: it is made from the readers, and shipped files conform to it.
#include "app/config/config.h"
#include "app/config/toml_table.h"
#include "tests/app/config/config_error.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace isochron::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;

namespace fs = std::filesystem;

fs::path configs() {
    return fs::path(test_support::source_root()) / "configs";
}

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

json json_of(const toml::node& node) {
    if (const auto* table = node.as_table()) {
        json object = json::object();
        for (const auto& [key, inner] : *table)
            object[std::string(key.str())] = json_of(inner);
        return object;
    }
    if (const auto* array = node.as_array()) {
        json list = json::array();
        for (const toml::node& inner : *array)
            list.push_back(json_of(inner));
        return list;
    }
    if (const auto flag = node.value_exact<bool>())
        return *flag;
    if (const auto whole = node.value_exact<std::int64_t>())
        return *whole;
    if (const auto number = node.value_exact<double>())
        return *number;
    return node.value_or(std::string());
}

/// The part of JSON Schema that the schema is written in.
class Checker {
  public:
    explicit Checker(json schema) : schema_(std::move(schema)) {}

    /// What is wrong with a file's text, as `place: what`; empty where nothing is.
    std::string complaint(const std::string& text) const {
        return check(json_of(toml::parse(text)), schema_, "");
    }

  private:
    std::string check(const json& value, const json& schema, const std::string& place) const {
        if (schema.contains("$ref"))
            return check(
                value, schema_.at(json::json_pointer(schema["$ref"].get<std::string>().substr(1))),
                place);
        if (schema.contains("anyOf")) {
            std::string last;
            for (const json& one : schema["anyOf"])
                if (last = check(value, one, place); last.empty())
                    return {};
            return last;
        }
        if (const std::string type = schema.at("type"); !is(value, type))
            return place + ": not of type " + type;
        if (value.is_object())
            return check_members(value, schema, place);
        if (value.is_array())
            return check_items(value, schema, place);
        if (schema.contains("enum") &&
            std::ranges::find(schema["enum"], value) == schema["enum"].end())
            return place + ": not one of the words";
        if (value.is_number() &&
            (value < schema.value("minimum", value) || value > schema.value("maximum", value)))
            return place + ": out of range";
        return {};
    }
    std::string check_members(const json& value, const json& schema,
                              const std::string& place) const {
        EXPECT_EQ(schema.at("additionalProperties"), false) << place;
        for (const auto& [key, inner] : value.items()) {
            if (!schema["properties"].contains(key))
                return place + "." + key + ": unknown";
            if (std::string found = check(inner, schema["properties"][key], place + "." + key);
                !found.empty())
                return found;
        }
        return {};
    }
    std::string check_items(const json& value, const json& schema, const std::string& place) const {
        if (value.size() < schema.value("minItems", std::size_t{0}) ||
            value.size() > schema.value("maxItems", value.size()))
            return place + ": too few or too many";
        for (const json& item : value)
            if (std::string found = check(item, schema.at("items"), place); !found.empty())
                return found;
        return {};
    }
    static bool is(const json& value, const std::string& type) {
        return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
               (type == "string" && value.is_string()) ||
               (type == "boolean" && value.is_boolean()) ||
               (type == "number" && value.is_number()) ||
               (type == "integer" && value.is_number_integer());
    }

    json schema_;
};

TEST(ConfigSchema, TheShippedOneIsTheReadersOwn) {
    std::istringstream shipped(text_of(configs() / "isochron.schema.json")), own(config_schema());
    std::string line, expected;
    bool more = true;
    for (int number = 1; more; ++number) {
        const bool one = !!std::getline(shipped, line), other = !!std::getline(own, expected);
        ASSERT_EQ(one ? line : "the end", other ? expected : "the end")
            << "configs/isochron.schema.json:" << number << "; renew it with: "
            << "build/release/isochron config schema > configs/isochron.schema.json";
        more = one;
    }
}

TEST(ConfigSchema, EveryShippedConfigurationKeepsToItAndNamesIt) {
    const Checker checker(json::parse(config_schema()));
    int files = 0;
    for (const auto& entry : fs::directory_iterator(configs())) {
        if (entry.path().extension() != ".toml")
            continue;
        const std::string text = text_of(entry.path());
        EXPECT_EQ(checker.complaint(text), "") << entry.path();
        EXPECT_THAT(text, testing::StartsWith("#:schema ./isochron.schema.json\n")) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 6);
}

TEST(ConfigSchema, WhatTheReadersRefuseIsRefused) {
    const Checker checker(json::parse(config_schema()));
    for (const char* text :
         {"versoin = 1\n", "version = 2\n", "[viewer]\neye_separation = 0.2\n",
          "[viewer]\nposition = [0.0, 1.6]\n", "[rendering]\ncontext = \"vulkan\"\n",
          "[rendering]\nvsync = 1\n", "[rendering]\nsamples = 1.5\n",
          "[rendering]\nbackground = [0, 0, 2]\n",
          "[[windows]]\n[[windows.viewports]]\nsise = [1, 1]\n", "windows = []\n",
          "[dtrack]\nport = 0\n[[dtrack.devices]]\nbody = 1\n",
          "[[osc]]\nprefix = 1\n[[osc.devices]]\n", "[coloring]\nmap = \"rainbow\"\n"}) {
        EXPECT_NE(checker.complaint(text), "") << text;
        EXPECT_NE(error_of(text), "no error") << text;
    }
    for (const char* text :
         {"[dtrack]\nport = 5000\n[[dtrack.devices]]\nname = \"head\"\nbody = 0\n",
          "[[dtrack]]\nport = 5000\n[[dtrack.devices]]\nname = \"head\"\nbody = 0\n",
          "[[viewers]]\nname = \"guide\"\n[[windows]]\n[[windows.viewports]]\n"
          "viewer = \"guide\"\n"}) {
        EXPECT_EQ(checker.complaint(text), "") << text;
        EXPECT_EQ(error_of(text), "no error") << text;
    }
}

TEST(ConfigSchema, OldSpellingsStayOutOfIt) {
    const std::string schema = config_schema();
    for (const char* old : {"colour", "grey"})
        EXPECT_EQ(schema.find(old), std::string::npos) << old;
    EXPECT_THAT(schema, HasSubstr("\"coloring\""));
}

} // namespace
} // namespace isochron::app
