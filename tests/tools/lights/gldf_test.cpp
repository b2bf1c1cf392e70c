// GLDF containers: the photometry inside is read by its own reader.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zip.h>

#include <map>
#include <numbers>
#include <string>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tools/lights/luminaire.h"

namespace nightcity::lights {
namespace {

TEST(Luminaire, APipeIsRefusedBeforeItIsOpened) {
  const test::TempFolder folder;
  const std::filesystem::path pipe = folder / "a.ies";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(read_luminaire(pipe), Error);
}

const std::string even_ies =
    "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 4 1 1 2 0 0 0\n1 1 50\n0 30 60 90\n0\n100 100 100 100\n";

std::string write_product(const std::string& files, const std::string& photometries) {
  return "<?xml version=\"1.0\"?><Root><GeneralDefinitions><Files>" + files +
         "</Files><Photometries>" + photometries + "</Photometries></GeneralDefinitions></Root>";
}

std::string refer_to(const std::string& id) {
  return "<Photometry id=\"p" + id + "\"><PhotometryFileReference fileId=\"" + id +
         "\"/></Photometry>";
}

const std::string one_file =
    "<File id=\"a\" contentType=\"ldc/ies\" type=\"localFileName\">A street.ies</File>";

class Gldf : public testing::Test {
 protected:
  Luminaire read(const std::map<std::string, std::string>& entries) {
    const std::filesystem::path file = folder_ / "a.gldf";
    std::filesystem::remove(file);
    zip_t* zip = zip_open(file.c_str(), ZIP_CREATE, nullptr);
    for (const auto& [name, bytes] : entries)
      zip_file_add(zip, name.c_str(), zip_source_buffer(zip, bytes.data(), bytes.size(), 0), 0);
    zip_close(zip);
    return read_luminaire(file);
  }
  std::string error_of(const std::map<std::string, std::string>& entries) {
    try {
      read(entries);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  test::TempFolder folder_;
};

TEST_F(Gldf, TheFirstPhotometryIsRead) {
  const Luminaire luminaire = read({{"product.xml", write_product(one_file, refer_to("a"))},
                                    {"ldc/a street.ies", even_ies},
                                    {"geo/lamp.l3d", "PK"}});
  EXPECT_NEAR(luminaire.flux_lm, 200 * std::numbers::pi, 1e-9);
  EXPECT_TRUE(luminaire.notes.empty());
}

TEST_F(Gldf, OfSeveralPhotometriesTheFirstIsReadAndToldSo) {
  const std::string other = "<File id=\"b\" type=\"localFileName\">b.ldt</File>";
  const Luminaire luminaire =
      read({{"product.xml", write_product(other + one_file, refer_to("a") + refer_to("b"))},
            {"ldc/A street.ies", even_ies},
            {"ldc/b.ldt", "none"}});
  EXPECT_NEAR(luminaire.flux_lm, 200 * std::numbers::pi, 1e-9);
  EXPECT_EQ(
      luminaire.notes,
      (std::vector<std::string>{"the file defines 2 photometries, of which the first is read"}));
}

TEST_F(Gldf, FaultsAreNamed) {
  EXPECT_NE(error_of({{"product.xml", write_product(one_file, "")}, {"a.ies", even_ies}})
                .find("names no file of photometry"),
            std::string::npos);
  EXPECT_NE(error_of({{"product.xml", write_product(one_file, refer_to("a"))}, {"b.ies", even_ies}})
                .find("A street.ies"),
            std::string::npos);
  EXPECT_NE(error_of({{"product.xml", write_product("<File id=\"a\" type=\"url\">http://x</File>",
                                                    refer_to("a"))}})
                .find("address"),
            std::string::npos);
  EXPECT_NE(error_of({{"product.xml", "<Root"}, {"a.ies", even_ies}}).find("broken XML"),
            std::string::npos);
  EXPECT_NE(error_of({{"product.xml", write_product(one_file, refer_to("a"))},
                      {"ldc/A street.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 x"}})
                .find("A street.ies:3"),
            std::string::npos);
  EXPECT_NE(error_of({{"a.ies", even_ies}}).find("product.xml"), std::string::npos);
}

}  // namespace
}  // namespace nightcity::lights
