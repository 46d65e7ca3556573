// Words in a picture may have any character, and it stays XML.
#include "run/svg.hpp"

#include <gmock/gmock.h>

namespace berm::run {
namespace {

TEST(Svg, WordsAreEscapedWhereverTheyStand) {
  SvgPanel panel(0, 0, 1, 1, 10, 10, 100);
  panel.title("title of a<b>&c.pcap");
  panel.axes(1.0, "x<b>&c", "y<b>&c");
  panel.text(0.5, 0.5, "text a<b>&c");
  const std::string drawn = panel.body();
  for (const char* words : {"title of a&lt;b&gt;&amp;c.pcap", "x&lt;b&gt;&amp;c", "y&lt;b&gt;&amp;c", "text a&lt;b&gt;&amp;c"}) EXPECT_THAT(drawn, testing::HasSubstr(words));
  EXPECT_THAT(drawn, testing::Not(testing::HasSubstr("<b>")));
}

}  // namespace
}  // namespace berm::run
