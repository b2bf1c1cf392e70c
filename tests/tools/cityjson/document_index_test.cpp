#include "tools/cityjson/document_index.h"

#include <gtest/gtest.h>

#include <string>

namespace nightcity::cityjson {
namespace {

TEST(DocumentIndex, FindsPartsWhereverTheirBracketsAndQuotesLie) {
  const std::string object =
      R"({"type":"Building","geometry":[[[[1,2],["]]}}"]]],[{}],{"\"]":[]}],"children":["b"]})";
  const std::string vertices = "[[1,2,3],[-4,5,6],[7,8,9],[10,11,12]]";
  for (std::size_t blanks = 0; blanks < 40; ++blanks) {
    const std::string gap(blanks, ' ');
    const std::string text = "{\"vertices\":" + gap + vertices + ",\"CityObjects\":{\"a\":" + gap +
                             object + gap + ",\"b\":[[]," + gap + "[]]}}";
    const DocumentIndex index = index_document(text, "test");
    EXPECT_EQ(index.members.at("vertices"), vertices);
    ASSERT_EQ(index.objects.size(), 2u);
    EXPECT_EQ(index.objects[0].id, "a");
    EXPECT_EQ(index.objects[0].type, "Building");
    EXPECT_EQ(index.objects[0].children, "[\"b\"]");
    EXPECT_EQ(index.objects[0].value, object);
    EXPECT_EQ(index.objects[1].value, "[[]," + gap + "[]]");
  }
}

}  // namespace
}  // namespace nightcity::cityjson
