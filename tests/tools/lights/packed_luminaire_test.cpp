// Photometry in archives and streams that are no GLDF.
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "support/error_message.h"
#include "support/pack_archive.h"
#include "support/temp_folder.h"
#include "tools/lights/luminaire.h"

namespace nightcity::lights {
namespace {

// 100 cd in all directions below: 200 pi lm.
const std::string below =
    "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n100 100\n";
const std::string product =
    "<Root><GeneralDefinitions><Files><File id=\"a\" type=\"localFileName\">a.ies</File></Files>"
    "<Photometries><Photometry><PhotometryFileReference fileId=\"a\"/></Photometry>"
    "</Photometries></GeneralDefinitions></Root>";

double flux_of(const std::filesystem::path& path) {
  return read_luminaire(path).flux_lm;
}

TEST(PackedLuminaire, EveryFormHoldsTheSameLight) {
  const test::TempFolder folder;
  constexpr double expected = 200 * std::numbers::pi;
  for (const char* form : test::archive_forms) {
    const auto path = folder / ("a" + std::string(form));
    test::pack_archive(path, {{"sheet.pdf", "%PDF"}, {"meta.xml", "<a/>"}, {"ies/a.ies", below}});
    EXPECT_NEAR(flux_of(path), expected, 1e-9) << form;
    // This is what a GLDF is, in any form.
    test::pack_archive(path, {{"product.xml", product}, {"ldc/b.ies", "x"}, {"ldc/a.ies", below}});
    EXPECT_NEAR(flux_of(path), expected, 1e-9) << form;
  }
  for (const char* form : test::stream_forms) {
    const auto path = folder / ("a.ies" + std::string(form));
    test::pack_stream(path, below);
    EXPECT_NEAR(flux_of(path), expected, 1e-9) << form;
  }
}

TEST(PackedLuminaire, SeveralOrNoneAreNamed) {
  const test::TempFolder folder;
  const auto why = [&](const test::ZipFiles& files) {
    test::pack_archive(folder / "a.7z", files);
    return test::message_of([&] { flux_of(folder / "a.7z"); });
  };
  EXPECT_NE(
      why({{"a.ies", below}, {"b.ldt", "x"}}).find("several files of photometry (a.ies, b.ldt)"),
      std::string::npos);
  EXPECT_NE(why({{"a.pdf", "x"}}).find("holds no .ldt, .ies, .xml"), std::string::npos);
  EXPECT_NE(why({{"a.xml", "<a/>"}}).find("neither photometry nor a product.xml"),
            std::string::npos);
}

}  // namespace
}  // namespace nightcity::lights
