// Keys on the panel in the room, for a hand that has no keyboard: digits for a number, letters for
// a text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace isochron::app {

/// A field of the panel asks for keys when it is clicked; the keys lie over the panel until the user
/// accepts the text or gives up. The field takes the text in the frame after.
class RoomKeys {
  public:
    enum class Kind : std::uint8_t { number, whole_number, words };

    /// The keys of the current Dear ImGui context; null: it has a keyboard.
    static RoomKeys* here();
    /// Lets the fields of the current context use these keys, as long as they live.
    void use();

    /// @param field that asks @param text that it has now
    void open(std::uint32_t field, Kind kind, std::string text);
    bool is_open() const { return field_ != 0; }
    /// The text that the user has accepted for a field; returned once.
    std::optional<std::string> take(std::uint32_t field);

    /// Lays the keys out over the panel, if they are for this field. Called where the field is laid
    /// out, so that a menu in which the field lies stays open.
    void draw(std::uint32_t field);

  private:
    void press(const std::string& key);
    void row_of_keys(const char* keys, float width);

    std::uint32_t field_ = 0, accepted_for_ = 0;
    Kind kind_ = Kind::number;
    bool opening_ = false; ///< asked for since the last layout
    bool fresh_ = false;   ///< the first key replaces the text
    bool capital_ = false;
    std::string text_, accepted_;
};

/// What a field does after it was laid out in a panel with such keys: a click without a drag asks
/// for them. @return the text that the user has accepted for this field
std::optional<std::string> keyed_text(std::uint32_t field, RoomKeys::Kind kind,
                                      const std::string& text);

} // namespace isochron::app
