// Reads tables of TOML files: one rule for each type of value, the keys from the lists of fields.
#pragma once

#include "app/config/config_checks.h"
#include "app/config/config_words.h"
#include "interaction/trackers/calibration.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace isochron::app {

struct Thing {
    const char* what;
    std::string_view name;
};
inline Thing thing_with(const stereo::Viewer& viewer) {
    return {"viewer", viewer.name};
}
inline Thing thing_with(const stereo::Window& window) {
    return {"window", window.name};
}
template <class Device>
    requires requires(Device each) { each.device.name; }
Thing thing_with(const Device& each) {
    return {"device", each.device.name};
}

/// Reads the table at a place, and says where it is if it cannot.
class TableReader {
  public:
    /// @param config whose viewers tables name; those of others name none
    explicit TableReader(const Config& config) : config_(config) {}

    template <Table T>
    void read(TomlTable at, T& table) {
        each_field([&](const Field& field, auto&& member) { read(at, field, member, table); },
                   table);
        if (!at.is_there())
            return;
        if constexpr (requires { table.line.number; })
            table.line.number = at.line();
        else if constexpr (requires { table.line = at.line(); })
            table.line = at.line();
        if constexpr (requires { check(at, config_, table); })
            check(at, config_, table);
    }

  private:
    template <class T, class Owner>
    void read(TomlTable& at, const Field& field, T& member, Owner& owner) {
        if (!field.in_files)
            return;
        if constexpr (Tables<T>) {
            read_list(at, field, member, owner);
        } else if constexpr (Table<T>) {
            read(at.within(field.key), member);
        } else if constexpr (kIsOptional<T>) {
            if (const toml::node* node = at.take(field.key)) {
                if constexpr (Table<typename T::value_type>)
                    read(at.within(field.key), member.emplace());
                else if constexpr (Worded<T>)
                    take({at, field, *node}, member);
                else
                    take({at, field, *node}, member.emplace());
            }
        } else if (const toml::node* node = at.take(field.key)) {
            take({at, field, *node}, member);
        }
    }

    template <class T, class Owner>
    void read_list(TomlTable& at, const Field& field, std::vector<T>& list, Owner& owner) {
        const auto read_item = [&](std::vector<T>& into, std::string_view key,
                                   const toml::node& node) {
            TomlTable item = at.item(key, node);
            read(item, into.back());
            if (&into != &list)
                refuse_twin(item, into);
            item.finish();
        };
        const auto add = [&](std::vector<T>& into) {
            T& item = into.emplace_back();
            if constexpr (requires { item.name.empty(); })
                if (!item.name.empty() && into.size() > 1)
                    item.name += fmt::format(" {}", into.size());
            if constexpr (requires { begin(std::as_const(owner), into); })
                begin(std::as_const(owner), into);
        };
        const toml::node* node = at.take(field.key);
        const toml::node* one = field.one ? at.take(field.one) : nullptr;
        if (one && !(one == node && one->is_array())) {
            if (list.empty())
                add(list);
            read_item(list, field.one, *one);
            if (node && node != one)
                at.fail(field.key, fmt::format("[{0}] describes the one {0} already", field.one));
            return;
        }
        if (!node)
            return;
        const toml::array* array = node->as_array();
        if (!array || array->empty() || !array->is_homogeneous(toml::node_type::table))
            at.fail(field.key,
                    fmt::format("expected [[{}]] tables, got {}", field.key, type_name(*node)));
        std::vector<T> items;
        for (const toml::node& element : *array) {
            add(items);
            read_item(items, field.key, element);
        }
        list = std::move(items);
    }

    /// Messages, and the names of pictures, tell devices, viewers and windows apart by name.
    template <class T>
    void refuse_twin(const TomlTable& item, const std::vector<T>& all) {
        if constexpr (requires { thing_with(all.back()); }) {
            const auto [what, name] = thing_with(all.back());
            if (name.empty())
                item.fail("name", fmt::format("a {} needs a name", what));
            if (std::ranges::count(all, name, [](const T& each) { return thing_with(each).name; }) >
                1)
                item.fail("name", fmt::format("two {}s are called '{}'", what, name));
        }
    }

    /// A value of the file.
    struct Given {
        const TomlTable& at;
        Field field;
        const toml::node& node;

        [[noreturn]] void fail(const std::string& message) const { at.fail(field.key, message); }
        template <class T>
        T exactly(const char* expected) const {
            if (const auto value = node.value_exact<T>())
                return *value;
            fail(fmt::format("expected {}, got {}", expected, type_name(node)));
        }
        template <class T>
        void expect_in_range(const char* what, T value) const {
            const auto number = static_cast<double>(value);
            if (!std::isfinite(number) || number < field.low || number > field.high)
                fail(fmt::format("expected {} from {} to {}, got {}", what, field.low, field.high,
                                 value));
        }
        double number() const {
            const auto value = node.is_number() ? node.value<double>() : std::nullopt;
            if (!value)
                fail(fmt::format("expected a number, got {}", type_name(node)));
            expect_in_range("a number", *value);
            return *value;
        }
        double whole_number() const {
            const double value = number();
            if (value != std::floor(value))
                fail(fmt::format("expected whole numbers, got {}", value));
            return value;
        }
        /// @param size of the array, or most of it @param words its expected size in words
        template <class T>
        std::vector<T> numbers(std::size_t least, std::size_t most, const char* words) const {
            const toml::array* array = node.as_array();
            if (!array || array->size() < least || array->size() > most)
                fail(
                    fmt::format("expected an array of {}{} numbers, got {}", words, most,
                                array ? fmt::format("one of {}", array->size()) : type_name(node)));
            std::vector<T> values;
            for (const toml::node& element : *array) {
                const Given one{at, field, element};
                values.push_back(
                    static_cast<T>(std::integral<T> ? one.whole_number() : one.number()));
            }
            return values;
        }
        /// @param words one of which it is
        std::string word(const std::vector<std::string>& words) const {
            const std::string value(new_spelling(exactly<std::string>("a string")));
            if (std::ranges::find(words, value) == words.end())
                fail(unknown_word("value", value, words));
            return value;
        }
    };

    void take(const Given& given, bool& into) {
        if (const auto& words = given.field.words; words[0])
            into = given.word({words[0], words[1]}) == words[1];
        else
            into = given.exactly<bool>("true or false");
    }
    template <std::integral T>
    void take(const Given& any, T& into) {
        Given given = any;
        given.field.low = std::max(given.field.low, double(std::numeric_limits<T>::lowest()));
        given.field.high = std::min(given.field.high, double(std::numeric_limits<T>::max()));
        const auto value = given.exactly<std::int64_t>("an integer");
        given.expect_in_range("an integer", value);
        into = static_cast<T>(value);
    }
    /// A viewer, by name.
    void take(const Given& given, std::size_t& into) {
        std::vector<std::string> names;
        for (const stereo::Viewer& viewer : config_.installation.viewers)
            names.push_back(viewer.name);
        into = std::ranges::find(names, given.word(names)) - names.begin();
    }
    template <std::floating_point T>
    void take(const Given& given, T& into) {
        into = static_cast<T>(given.number() / given.field.per);
    }
    void take(const Given& given, interaction::Seconds& into) {
        into = interaction::Seconds(given.number() / given.field.per);
    }
    void take(const Given& given, std::string& into) {
        const auto words = words_of_text(given.field.key);
        into = words.empty() ? given.exactly<std::string>("a string") : given.word(words);
    }
    template <Worded T>
    void take(const Given& given, T& into) {
        into = value_of<T>(given.word(words_of<T>(given.field)));
    }
    template <glm::length_t n, class T>
    void take(const Given& any, glm::vec<n, T>& into) {
        const Given given{any.at, within_reach(any.field), any.node};
        const auto values = given.numbers<T>(n, n, "");
        for (glm::length_t i = 0; i < n; ++i)
            into[i] = values[static_cast<std::size_t>(i)];
    }
    /// Heading, pitch and roll in degrees.
    void take(const Given& given, glm::quat& into) {
        glm::vec3 degrees;
        take(given, degrees);
        into = interaction::rotation_from_angles(glm::radians(degrees));
    }
    void take(const Given& given, std::array<double, 2>& into) {
        const auto values = given.numbers<double>(2, 2, "");
        into = {values[0], values[1]};
        if (!given.field.any_order && !(into[0] < into[1]))
            given.fail(
                fmt::format("expected two ascending numbers, got {} and {}", into[0], into[1]));
    }
    template <class T>
        requires std::integral<T> || std::floating_point<T>
    void take(const Given& given, std::vector<T>& into) {
        into = given.numbers<T>(0, given.field.most, "at most ");
    }
    void take(const Given& given, interaction::Endpoint& into) {
        const auto text = given.exactly<std::string>("a string");
        const auto endpoint = interaction::endpoint_from(text);
        if (!endpoint)
            given.fail(fmt::format("expected a numeric address such as 192.168.0.10 or "
                                   "192.168.0.10:5000, got '{}'",
                                   text));
        into = *endpoint;
    }
    void take(const Given& given, NumberInDTrack& into) {
        into.device.kind = into.kind;
        take(given, into.device.id);
    }
    /// A setting of a type that no file says.
    template <class T>
    void take(const Given& given, T&) {
        given.fail("no file says it");
    }

    const Config& config_;
};

} // namespace isochron::app
