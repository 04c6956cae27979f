// Stand-ins for NaN and infinities.
#include "index/readers/decoders/vtk/vtk_numbers.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/text_header.h"
#include "index/system/mapped_file.h"

#include <fmt/format.h>

#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

namespace isochron::index {
namespace {

/// Values near the highest f32, which f32 and f64 have exactly.
constexpr float kHighest = std::numeric_limits<float>::max();
constexpr std::array<float, 3> kStandIns{kHighest, kHighest*(1 - 0x1p-23f), -kHighest};
constexpr std::array<double, 3> kStoodFor{std::numeric_limits<double>::quiet_NaN(),
                                          std::numeric_limits<double>::infinity(),
                                          -std::numeric_limits<double>::infinity()};

/// 0 NaN, 1 infinity, 2 minus infinity; -1: another word.
int hard_number(std::string_view word) {
    const bool negative = word.starts_with('-');
    if (negative || word.starts_with('+'))
        word.remove_prefix(1);
    constexpr std::size_t kLongest = 8;
    if (word.size() < 3 || word.size() > kLongest || (word.front() | 0x20) < 'i')
        return -1;
    const std::string name = lower_case(word);
    if (name == "nan")
        return 0;
    return name == "inf" || name == "infinity" ? (negative ? 2 : 1) : -1;
}

template <class Array>
void put_back(Array& array) {
    using Value = typename Array::ValueType;
    Value* const values = array.GetPointer(0);
    for (vtkIdType i = 0; i < array.GetNumberOfValues(); ++i)
        for (std::size_t n = 0; n < kStandIns.size(); ++n)
            if (values[i] == static_cast<Value>(kStandIns[n]))
                values[i] = static_cast<Value>(kStoodFor[n]);
}

} // namespace

std::optional<std::string> with_stand_ins(std::string_view text, const std::string& file) {
    constexpr std::string_view kBlanks = " \t\r\n";
    std::array<std::string, kStandIns.size()> words;
    for (std::size_t n = 0; n < words.size(); ++n)
        words[n] = fmt::format("{:.17g}", static_cast<double>(kStandIns[n]));
    std::string easy;
    std::size_t copied = 0, lines = 0, at = 0;
    bool ambiguous = false;
    constexpr std::size_t kTitle = 3; // lines that may hold any words
    for (; at < text.size() && lines < kTitle; ++at)
        lines += text[at] == '\n';
    while ((at = text.find_first_not_of(kBlanks, at)) != text.npos) {
        const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
        const std::string_view word = text.substr(at, end - at);
        // Names of arrays follow a word; numbers follow numbers or a line's end.
        const bool begins_line = text[at - 1] == '\n' || text[at - 1] == '\r';
        const char before = text[std::min(text.find_last_not_of(kBlanks, at - 1), at - 1)];
        const bool among_numbers =
            begins_line || std::string_view("0123456789nfyNFY").find(before) != text.npos;
        ambiguous = ambiguous || word.find("3.40282") < 2;
        if (const int number = among_numbers ? hard_number(word) : -1; number >= 0) {
            easy += text.substr(copied, at - copied);
            easy += words[static_cast<std::size_t>(number)];
            copied = end;
        }
        at = end;
    }
    if (copied == 0)
        return std::nullopt;
    if (ambiguous)
        throw Error("{}: holds NaN or infinities beside {}, which VTK cannot tell apart", file,
                    kHighest);
    return easy.append(text.substr(copied));
}

std::optional<std::string> text_with_stand_ins(const std::filesystem::path& file) {
    constexpr std::size_t kHead = 1024;
    std::istringstream head(head_of(file, kHead));
    std::string line;
    for (int i = 0; i < 3; ++i)
        std::getline(head, line);
    if (!lower_case(line).starts_with("ascii"))
        return std::nullopt;
    const MappedFile text(file);
    return with_stand_ins({reinterpret_cast<const char*>(text.bytes().data()), text.bytes().size()},
                          file.string());
}

void replace_stand_ins(vtkDataSetAttributes& arrays) {
    for (int i = 0; i < arrays.GetNumberOfArrays(); ++i) {
        vtkAbstractArray* array = arrays.GetAbstractArray(i);
        if (auto* floats = vtkFloatArray::SafeDownCast(array))
            put_back(*floats);
        else if (auto* doubles = vtkDoubleArray::SafeDownCast(array))
            put_back(*doubles);
    }
}

} // namespace isochron::index
