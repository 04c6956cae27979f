// Writes an installation as TOML, by the keys in config_fields.h.
#include "app/config/display_config_text.h"

#include "app/config/config_words.h"

#include <fmt/format.h>

namespace isochron::app {
namespace {

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            result += fmt::format("\\{}", c);
        else if (code < 0x20 || code == 0x7f)
            result += fmt::format("\\u{:04x}", code);
        else
            result += c;
    }
    return result + '"';
}

/// Whether the other keys of a viewer say this one.
bool is_said(const stereo::Viewer& viewer, const Field& field) {
    return viewer.left_eye && std::string_view(field.key) == "eye_separation";
}

class Writer {
  public:
    explicit Writer(const stereo::Installation& installation) : installation_(installation) {}

    /// The keys of a table that differ from the usual, then the tables in it.
    template <Table T>
    std::string text_of(const std::string& path, const T& table, const T& usual) const {
        std::string keys, inner;
        each_field(
            [&]<class V>(const Field& field, const V& value, const V& common) {
                const std::string key = path.empty() ? field.key : path + "." + field.key;
                if constexpr (Tables<V>) {
                    for (const auto& item : value)
                        inner += fmt::format("\n[[{}]]\n{}", key,
                                             text_of(key, item, typename V::value_type()));
                } else if constexpr (Table<V>) {
                    inner += fmt::format("\n[{}]\n{}", key, text_of(key, value, common));
                } else if (field.told || value != common) {
                    if constexpr (requires { is_said(table, field); })
                        if (is_said(table, field))
                            return;
                    keys += fmt::format("{} = {}\n", field.key, value_text(field, value));
                }
            },
            table, usual);
        return keys + inner;
    }

  private:
    std::string value_text(const Field& field, bool value) const {
        return field.words[0] ? quoted(field.words[value]) : fmt::to_string(value);
    }
    std::string value_text(const Field&, int value) const { return fmt::to_string(value); }
    /// With the fewest digits that read back as the same number.
    std::string value_text(const Field&, float value) const { return fmt::to_string(value); }
    std::string value_text(const Field&, const std::string& value) const { return quoted(value); }
    std::string value_text(const Field&, stereo::StereoMode mode) const {
        return quoted(std::string(stereo::name_of(mode)));
    }
    std::string value_text(const Field&, std::size_t viewer) const {
        return quoted(installation_.viewers[viewer].name);
    }
    template <class T>
    std::string value_text(const Field& field, const std::optional<T>& value) const {
        return value_text(field, *value);
    }
    template <glm::length_t n, class T>
    std::string value_text(const Field& field, const glm::vec<n, T>& value) const {
        std::string text;
        for (glm::length_t i = 0; i < n; ++i)
            text += (i > 0 ? ", " : "[") + value_text(field, value[i]);
        return text + "]";
    }

    const stereo::Installation& installation_;
};

} // namespace

std::string display_config_text(const stereo::Installation& installation) {
    return "version = 1\n" + Writer(installation).text_of("", installation, stereo::Installation());
}

} // namespace isochron::app
