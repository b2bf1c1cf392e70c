// Tables and plots as other programs read them.
#include "runtime/measure/table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/error.h"
#include "runtime/measure/plot.h"
#include "support/temp_folder.h"

namespace nightcity::measure {
namespace {

TEST(Table, CsvReadsBackWhateverTheCellsHold) {
  const test::TempFolder folder;
  const Table table{{"name", "value"},
                    {{"", "1"}, {"a,b", "-2e-5"}, {"say \"no\"", ""}, {"two\nlines", "x"}}};
  write_csv(folder / "t.csv", table);
  const Table back = read_csv(folder / "t.csv");
  EXPECT_EQ(back.columns, table.columns);
  EXPECT_EQ(back.rows, table.rows);
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(Table, BrokenCsvIsRefusedWithItsRow) {
  const test::TempFolder folder;
  test::write_text(folder / "ragged.csv", "a,b\n1,2\n3\n");
  test::write_text(folder / "quote.csv", "a,b\n1,\"2\n");
  test::write_text(folder / "empty.csv", "");
  for (const auto& [file, place] :
       {std::pair{"ragged.csv", "row 3"}, std::pair{"quote.csv", "row 2"},
        std::pair{"empty.csv", "header"}, std::pair{"none.csv", "cannot be read"}}) {
    try {
      read_csv(folder / file);
      FAIL() << file;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
    }
  }
}

TEST(Table, MarkdownSetsNumbersFlushRight) {
  EXPECT_EQ(to_markdown({{"name", "ms"}, {{"a", "1.5"}, {"b", "2"}}}),
            "| name | ms |\n|---|---:|\n| a | 1.5 |\n| b | 2 |\n");
}

TEST(Table, AMissingColumnIsNamed) {
  EXPECT_EQ((Table{{"a", "b"}, {}}.column("b")), 1u);
  EXPECT_THROW((Table{{"a", "b"}, {}}.column("c")), Error);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Plot, ShowsEveryPointThatALogarithmicAxisCanShow) {
  const Plot plot{"a < b",
                  "ms",
                  "error",
                  {{"one", {{1, 0.1, "first"}, {10, 0.01, "second"}}},
                   {"two", {{5, 0, "zero"}, {NAN, 1, "none"}, {2, 0.02, "third"}}}}};
  const std::string svg = to_svg(plot);
  EXPECT_EQ(count(svg, "<title>"), 3u);
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_NE(to_svg({"empty", "x", "y", {}}).find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace nightcity::measure
