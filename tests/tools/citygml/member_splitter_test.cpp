#include "tools/citygml/member_splitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "formats/error.h"

namespace nightcity::citygml {
namespace {

// Delivers a text in pieces of `step` bytes, so that every construct crosses a boundary once.
class TextSource : public city::ByteSource {
 public:
  TextSource(std::string text, std::size_t step) : text_(std::move(text)), step_(step) {}
  std::size_t read(char* out, std::size_t size) override {
    const std::size_t n = std::min({size, step_, text_.size() - at_});
    std::memcpy(out, text_.data() + at_, n);
    at_ += n;
    return n;
  }

 private:
  std::string text_;
  std::size_t step_, at_ = 0;
};

struct Cut {
  std::vector<std::string> names, texts;
  std::vector<std::size_t> lines;
  std::vector<bool> continued;
};

Cut cut(const std::string& text, MemberSplitter::Limits limits = {}, std::size_t step = 1 << 16) {
  TextSource source(text, step);
  MemberSplitter splitter(source, "test.gml", limits);
  Cut out;
  MemberBatch batch;
  while (splitter.next(batch)) {
    EXPECT_EQ(batch.first_member, out.names.size());
    for (const MemberBatch::Member& member : batch.members) {
      out.names.push_back(member.name);
      out.texts.emplace_back(batch.text(member));
      out.lines.push_back(member.line);
      out.continued.push_back(member.continued);
    }
  }
  return out;
}

const std::string awkward =
    "<?xml version='1.0'?>\n<!-- <a> -->\n<c:CityModel "
    "xmlns:c='http://www.opengis.net/citygml/2.0' "
    "a=\">'<\">\n"
    "<boundedBy/>\n<!-- <m></m> --><c:m x='/>'>\n<m>1</m><![CDATA[</c:m>]]></c:m>\n<?pi </c:m> "
    "?><n\n>t</n\n></c:CityModel>";

TEST(MemberSplitter, CommentsCdataQuotesAndInstructionsDoNotMislead) {
  const std::string text =
      awkward.substr(0, awkward.find(" a=")) + awkward.substr(awkward.find("\">\n") + 1);
  for (const std::size_t step : {1u, 2u, 3u, 7u, 65536u}) {
    const Cut c = cut(text, {}, step);
    EXPECT_EQ(c.names, (std::vector<std::string>{"boundedBy", "m", "n"})) << step;
    EXPECT_EQ(c.texts, (std::vector<std::string>{"<boundedBy/>",
                                                 "<c:m x='/>'>\n<m>1</m><![CDATA[</c:m>]]></c:m>",
                                                 "<n\n>t</n\n>"}));
    EXPECT_EQ(c.lines, (std::vector<std::size_t>{4, 5, 7}));
  }
}

TEST(MemberSplitter, JumpingToAMembersEndFindsTheSameAsFollowingEveryTag) {
  const std::string text =
      "<CityModel>\n<m>1</m><m><k/>\n</m ><mm><m/></mm><m><mm>2</mm></m><m><m>nested</m></m>"
      "<m><!-- </m> --></m><m><![CDATA[</m>]]></m>\n<m><? </m> ?></m><m "
      "a='?!'>!?</m><n><m2></m2></n></CityModel>";
  MemberSplitter::Limits every;
  every.every_tag = true;
  const Cut slow = cut(text, every);
  ASSERT_EQ(slow.texts.size(), 10u);
  EXPECT_EQ(slow.texts[4], "<m><m>nested</m></m>");
  for (const std::size_t step : {1u, 2u, 5u, 65536u}) {
    const Cut fast = cut(text, {}, step);
    EXPECT_EQ(fast.texts, slow.texts) << step;
    EXPECT_EQ(fast.lines, slow.lines) << step;
    EXPECT_EQ(fast.names, slow.names) << step;
  }
}

TEST(MemberSplitter, BatchesOfAnySizeHoldTheSameMembers) {
  std::string text = "<CityModel>";
  for (int i = 0; i < 100; ++i)
    text += "\n<m><k id=\"" + std::to_string(i) + "\">" +
            std::string(static_cast<std::size_t>(i), 'x') + "</k></m>";
  text += "\n</CityModel>";
  const Cut whole = cut(text);
  ASSERT_EQ(whole.texts.size(), 100u);
  EXPECT_EQ(whole.lines[99], 101u);
  for (const std::size_t batch : {1u, 50u, 1000u}) {
    MemberSplitter::Limits limits;
    limits.batch_bytes = batch;
    const Cut c = cut(text, limits, 13);
    EXPECT_EQ(c.texts, whole.texts);
    EXPECT_EQ(c.lines, whole.lines);
  }
}

TEST(MemberSplitter, MemberListsAreEntered) {
  const Cut c =
      cut("<CityModel><a/><gml:featureMembers><b/><c>1</c></gml:featureMembers><d/></CityModel>");
  EXPECT_EQ(c.texts, (std::vector<std::string>{"<a/>", "<b/>", "<c>1</c>", "<d/>"}));
}

TEST(MemberSplitter, LongTinIsCutBetweenTrianglesAndEachPieceIsWhole) {
  std::string tin = "<m><R id=\"r\"><tin>";
  for (int i = 0; i < 50; ++i) tin += "<gml:Triangle>" + std::to_string(i) + "</gml:Triangle>";
  tin += "</tin></R></m>";
  MemberSplitter::Limits limits;
  limits.piece_bytes = 300;
  const Cut c = cut("<CityModel><first/>" + tin + "<last/></CityModel>", limits, 11);
  ASSERT_GT(c.texts.size(), 5u);
  EXPECT_EQ(c.texts.front(), "<first/>");
  EXPECT_EQ(c.texts.back(), "<last/>");
  std::string joined;
  for (std::size_t i = 1; i + 1 < c.texts.size(); ++i) {
    EXPECT_EQ(c.continued[i], i > 1);
    ASSERT_TRUE(c.texts[i].starts_with("<m><R id=\"r\"><tin>") &&
                c.texts[i].ends_with("</tin></R></m>"))
        << c.texts[i];
    EXPECT_LT(c.texts[i].size(), 400u);
    joined += c.texts[i].substr(18, c.texts[i].size() - 18 - 14);
  }
  EXPECT_EQ("<m><R id=\"r\"><tin>" + joined + "</tin></R></m>", tin);
  EXPECT_FALSE(c.continued.back());
}

TEST(MemberSplitter, BrokenDocumentsAreErrorsWithALine) {
  for (const std::string text :
       {"<CityModel>\n<a></b></CityModel>", "<CityModel>\n<a>", "<CityModel>\n<a",
        "<CityModel>\n<!-- ", "<CityModel>\n<![CDATA[ ", "<CityModel>\n<?pi ",
        "<CityModel>\n<a b=\"", "<CityModel>\n</a>", "<CityModel>\n<!ELEMENT a>",
        "<CityModel>\n< a/></CityModel>", "<CityModel>\n<a <b/></CityModel>", "<CityModel>\n"}) {
    try {
      cut(text);
      ADD_FAILURE() << text;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("test.gml:2: "), std::string::npos) << text << "\n"
                                                                               << e.what();
    }
  }
}

TEST(MemberSplitter, DeepNestingAndOverlongMembersAreRefused) {
  std::string deep = "<CityModel>";
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_THROW(cut(deep), Error);
  MemberSplitter::Limits limits;
  limits.member_bytes = 1 << 20;
  EXPECT_THROW(cut("<CityModel><m>" + std::string(8 << 20, ' ') + "</m></CityModel>", limits),
               Error);
}

TEST(MemberSplitter, VersionIsTheNewestNamedAndBomIsSkipped) {
  const auto version = [](const std::string& text) {
    TextSource source(text, 100);
    return MemberSplitter(source, "t", {}).head().version;
  };
  EXPECT_EQ(version("<CityModel xmlns='http://www.opengis.net/citygml/1.0'/>"), "1.0");
  EXPECT_EQ(version("\xef\xbb\xbf<CityModel xmlns:b='http://www.opengis.net/citygml/building/2.0' "
                    "xmlns='http://www.opengis.net/citygml/1.1'/>"),
            "2.0");
  EXPECT_EQ(version("<CityModel xmlns='http://www.citygml.org/citygml/profiles/base/1.0'/>"),
            "1.0");
  EXPECT_EQ(version("<CityModel/>"), "");
}

}  // namespace
}  // namespace nightcity::citygml
