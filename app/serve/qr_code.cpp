// A link as a QR code, for the camera of a headset or a phone.
#include "app/serve/http_server.h"

#ifdef ISOCHRON_WITH_QRENCODE
#include <memory>
#include <qrencode.h>
#endif

namespace isochron::app {

#ifdef ISOCHRON_WITH_QRENCODE
std::string qr_code(const std::string& text) {
    constexpr int kQuiet = 2; ///< light modules around the code
    const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(
        QRcode_encodeString8bit(text.c_str(), 0, QR_ECLEVEL_L), &QRcode_free);
    if (!code)
        return {};
    const auto is_light = [&](int x, int y) {
        const bool within = x >= 0 && y >= 0 && x < code->width && y < code->width;
        return !within || (code->data[y * code->width + x] & 1) == 0;
    };
    std::string lines;
    for (int y = -kQuiet; y < code->width + kQuiet; y += 2) {
        for (int x = -kQuiet; x < code->width + kQuiet; ++x) {
            const bool upper = is_light(x, y), lower = is_light(x, y + 1);
            lines += upper && lower ? "\u2588" : upper ? "\u2580" : lower ? "\u2584" : " ";
        }
        lines += '\n';
    }
    return lines;
}
#else
std::string qr_code(const std::string&) {
    return {};
}
#endif

} // namespace isochron::app
