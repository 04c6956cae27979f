// The depth of XML elements, whatever comments, values and quotes contain.
#include "index/readers/decoders/vtk/xml_markup.h"

#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

namespace isochron::index {
namespace {

using testing::HasSubstr;

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i)
        all += text;
    return all;
}

TEST(XmlMarkup, NestedTooDeepIsRefused) {
    EXPECT_THAT(error_of([] { expect_shallow(repeated("<a>", 65), "d.vti"); }),
                HasSubstr("d.vti: elements nested more than 64 deep, at byte 192"));
    EXPECT_THAT(error_of([] { expect_shallow(repeated("<a b='/>'>", 300'000), "d.vti"); }),
                HasSubstr("d.vti: elements nested more than 64 deep"));
    expect_shallow(repeated("<a>", 64) + repeated("</a>", 64), "good.vti");
}

TEST(XmlMarkup, WithoutNestingIsLeftToTheParser) {
    for (const char* text : {"<a/>", "<a></a>", "<a b='>' c=\"<\"/>", "<!-- <a> -->",
                             "<![CDATA[<a>]]>", "<?a <a ?>", "<!DOCTYPE a>", "</a>"})
        expect_shallow(repeated(text, 1000), text);
    for (const char* text : {"", "<", "<a", "<a b='", "<!--", "<![CDATA[", "</", "not xml"})
        expect_shallow(text, text);
}

} // namespace
} // namespace isochron::index
