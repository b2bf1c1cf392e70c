// The same city in every form that portals pack it in.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "formats/error.h"
#include "support/error_message.h"
#include "support/pack_archive.h"
#include "tests/tools/city/read_city.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/city/archive_entries.h"
#include "tools/inputs/city_files.h"
#include "tools/inputs/file_format.h"
#include "tools/inputs/read_city.h"

namespace nightcity::inputs {
namespace {

namespace fs = std::filesystem;
using test::ArchiveWriter;
using test::make_archive;
using test::message_of;

std::string house(const std::string& id) {
  return test::city_model(test::member(test::building(id)));
}

test::City read(const fs::path& file) {
  test::City city;
  const auto sink = city.sink();
  city.report = read_city(file, {}, sink);
  return city;
}

std::string ids_of(const fs::path& file) {
  std::string ids;
  for (const city::CityObject& object : read(file).objects) ids += object.id + " ";
  return ids;
}

std::string names_of(const fs::path& file) {
  std::string names;
  const auto listing = city::list_archive(file);
  for (const city::ArchiveEntry& entry : listing->entries) names += entry.inside + "|";
  return names;
}

class ArchiveForms : public testing::Test {
 protected:
  fs::path write_tar(const std::string& name, const auto& fill) {
    const fs::path path = folder_ / name;
    fs::remove(path);
    ArchiveWriter out(path, ARCHIVE_FORMAT_TAR_PAX_RESTRICTED);
    fill(out);
    return path;
  }
  test::TempFolder folder_;
};

TEST_F(ArchiveForms, EveryFormHoldsTheSameCity) {
  for (const char* form : test::archive_forms) {
    const fs::path path = folder_ / ("city" + std::string(form));
    test::pack_archive(path, {{"readme.txt", "x"},
                              {"data/b.gml", house("b")},
                              {"data/._b.gml", "icon"},
                              {"data/a.gml", house("a")},
                              {"map.osm", "<osm version=\"0.6\"/>"}});
    EXPECT_STREQ(find_format(path).name, "CityGML") << form;
    const test::City city = read(path);
    ASSERT_EQ(city.objects.size(), 2u) << form;
    EXPECT_EQ(city.objects[0].id, "b") << form;
    EXPECT_EQ(city.objects[1].id, "a") << form;
    const std::map<std::string, std::size_t> expected{{".txt", 1}, {"OSM", 1}};
    EXPECT_EQ(city.report.passed_over, expected) << form;
  }
}

TEST_F(ArchiveForms, EveryStreamHoldsTheSameCity) {
  test::write_text(folder_ / "plain.gml", house("a"));
  const auto sample = read_city_head(folder_ / "plain.gml").sample;
  for (const char* form : test::stream_forms) {
    const fs::path path = folder_ / ("city.gml" + std::string(form));
    test::pack_stream(path, house("a"));
    EXPECT_STREQ(find_format(path).name, "CityGML") << form;
    EXPECT_EQ(ids_of(path), "a ") << form;
    EXPECT_EQ(read_city_head(path).sample, sample) << form;
    // In an archive, under a name that says so and under one that does not.
    const fs::path tar = folder_ / "all.tar";
    for (const std::string& inside : {"in/city.gml" + std::string(form), std::string("city.gml")}) {
      test::pack_archive(tar, {{inside, test::read_text(path)}});
      EXPECT_EQ(ids_of(tar), "a ") << inside << form;
    }
    // The first bytes decide.
    fs::rename(path, folder_ / "city.gml");
    EXPECT_EQ(ids_of(folder_ / "city.gml"), "a ") << form;
  }
}

TEST_F(ArchiveForms, ArchivesOfAllFormsLieInAllForms) {
  for (const std::string outer : {".zip", ".tar", ".tar.xz", ".7z", ".rar"})
    for (const std::string inner : {".zip", ".tar", ".tar.gz", ".tar.zst", ".7z", ".rar"}) {
      const fs::path path = folder_ / ("all" + outer);
      test::pack_archive(path, {{"tiles/one" + inner, make_archive(inner, {{"a.gml", house("a")}})},
                                {"b.gml", house("b")}});
      EXPECT_EQ(ids_of(path), "a b ") << outer << inner;
      EXPECT_EQ(names_of(path), "tiles/one" + inner + "/a.gml|b.gml|");
    }
}

TEST_F(ArchiveForms, FoldersAreSearchedForThem) {
  std::vector<fs::path> expected;
  for (const char* name : {"a.7z", "b.tar.gz", "c.gml.xz", "d.tar", "e.rar", "f.tzst"}) {
    const fs::path path = folder_ / name;
    if (std::string_view(name) == "c.gml.xz")
      test::pack_stream(path, house("a"));
    else if (std::string_view(name) == "f.tzst")
      test::write_text(path, make_archive(".tar.zst", {{"a.gml", house("a")}}));
    else
      test::pack_archive(path, {{"a.gml", house("a")}});
    expected.push_back(path);
  }
  test::pack_archive(folder_ / "g.7z", {{"dem.tif", "II*"}});
  EXPECT_EQ(city_files(folder_.path()), expected);
}

TEST_F(ArchiveForms, NamesLeadNowhere) {
  const fs::path tar = write_tar("a.tar", [](ArchiveWriter& out) {
    out.add("../../escaped.gml", house("up"));
    out.add("/absolute.gml", house("root"));
    out.add("./here.gml", house("here"));
    out.add("PaxHeaders.12/here.gml", "30 mtime=1\n");
  });
  EXPECT_EQ(ids_of(tar), "up root here ");
  EXPECT_EQ(names_of(tar), "../../escaped.gml|/absolute.gml|here.gml|");
  EXPECT_FALSE(fs::exists(folder_.path().parent_path().parent_path() / "escaped.gml"));
  EXPECT_FALSE(fs::exists("/absolute.gml"));
}

TEST_F(ArchiveForms, LinksAndDevicesAreLeftOutAndAHardLinkIsItsFile) {
  const fs::path tar = write_tar("a.tar.gz", [](ArchiveWriter& out) {
    out.add_other("dir", AE_IFDIR);
    out.add("dir/a.gml", house("a"));
    out.add_hard_link("b.gml", "dir/a.gml");
    out.add_hard_link("c.gml", "nowhere.gml");
    out.add_link("d.gml", "/etc/passwd");
    out.add_link("e.gml", "dir/a.gml");
    out.add_other("f.gml", AE_IFCHR);
    out.add_other("g.gml", AE_IFIFO);
  });
  EXPECT_EQ(names_of(tar), "dir/a.gml|b.gml|");
  const test::City city = read(tar);
  EXPECT_EQ(city.objects.size(), 2u);
  const std::map<std::string, std::size_t> expected{{"link", 3}, {"device", 2}};
  EXPECT_EQ(city.report.passed_over, expected);
  const fs::path links =
      write_tar("b.tar", [](ArchiveWriter& out) { out.add_link("d.gml", "/etc/passwd"); });
  EXPECT_NE(message_of([&] { find_format(links); }).find("but links alone"), std::string::npos);
}

TEST_F(ArchiveForms, ALinkInAZipIsLeftOut) {
  const fs::path path = folder_ / "a.zip";
  zip_t* const zip = zip_open(path.c_str(), ZIP_CREATE, nullptr);
  const std::string text = house("a"), target = "../a.gml";
  zip_file_add(zip, "a.gml", zip_source_buffer(zip, text.data(), text.size(), 0), 0);
  const zip_int64_t link =
      zip_file_add(zip, "b.gml", zip_source_buffer(zip, target.data(), target.size(), 0), 0);
  zip_file_set_external_attributes(zip, static_cast<zip_uint64_t>(link), 0, ZIP_OPSYS_UNIX,
                                   0120777u << 16);
  ASSERT_EQ(zip_close(zip), 0);
  EXPECT_EQ(ids_of(path), "a ");
  EXPECT_EQ(city::list_archive(path)->left_out.at("link"), 1u);
}

TEST_F(ArchiveForms, ALaterEntryOfATarReplacesAnEarlierOne) {
  const fs::path tar = write_tar("a.tar", [](ArchiveWriter& out) {
    out.add("a.gml", house("old"));
    out.add("b.gml", house("b"));
    out.add("./a.gml", house("new"));
  });
  EXPECT_EQ(ids_of(tar), "new b ");
}

TEST_F(ArchiveForms, HolesOfASparseFileAreZeros) {
  const std::string text = "PAR1 and more";
  for (const int format : {ARCHIVE_FORMAT_TAR_PAX_RESTRICTED, ARCHIVE_FORMAT_TAR_GNUTAR}) {
    const fs::path path = folder_ / "a.tar";
    fs::remove(path);
    ArchiveWriter(path, format).add_sparse("a.bin", 100'000, 65'536, text);
    const auto listing = city::list_archive(path);
    ASSERT_EQ(listing->entries.size(), 1u);
    const auto source = listing->entries[0].open("a");
    const std::string bytes = city::read_next(*source, 200'000);
    ASSERT_EQ(bytes.size(), 100'000u);
    EXPECT_EQ(bytes.substr(65'536, text.size()), text);
    EXPECT_EQ(bytes.find_first_not_of('\0'), 65'536u);
    EXPECT_EQ(bytes.find_last_not_of('\0'), 65'535u + text.size());
  }
}

TEST_F(ArchiveForms, NamesAreInUtf8WhateverTheyWereIn) {
  for (const char* form : {".tar", ".7z", ".zip"}) {
    const fs::path path = folder_ / ("a" + std::string(form));
    test::pack_archive(path, {{"Gebäude/Straße €.gml", house("a")}});
    EXPECT_EQ(names_of(path), "Gebäude/Straße €.gml|") << form;
  }
  // A tar of a system in Latin 1, which the archive does not say.
  std::string latin = make_archive(".tar", {{"geb-ude.gml", house("a")}});
  latin[3] = '\xE4';
  // The sum of the header's bytes stands in octal at 148.
  const auto add_to_sum = [&](int more) {
    const int sum = std::stoi(latin.substr(148, 6), nullptr, 8) + more;
    for (int i = 0; i < 6; ++i)
      latin[static_cast<std::size_t>(153 - i)] = static_cast<char>('0' + (sum >> (3 * i) & 7));
  };
  add_to_sum(0xE4 - '-');
  test::write_text(folder_ / "b.tar", latin);
  EXPECT_EQ(names_of(folder_ / "b.tar"), "gebäude.gml|");
  EXPECT_EQ(ids_of(folder_ / "b.tar"), "a ");
}

TEST_F(ArchiveForms, ATarWithoutAMarkIsToldByItsSum) {
  const fs::path path = folder_ / "old.gml";  // whatever its name says
  ArchiveWriter(path, ARCHIVE_FORMAT_TAR_USTAR).add("a.gml", house("a"));
  std::string bytes = test::read_text(path);
  int sum = 0;
  for (std::size_t i = 257; i < 265; ++i) sum += static_cast<unsigned char>(bytes[i]);
  std::fill(bytes.begin() + 257, bytes.begin() + 265, '\0');
  int rest = std::stoi(bytes.substr(148, 6), nullptr, 8) - sum;
  for (std::size_t i = 153; i >= 148; --i, rest >>= 3) bytes[i] = static_cast<char>('0' + rest % 8);
  test::write_text(path, bytes);
  EXPECT_EQ(ids_of(path), "a ");
}

TEST_F(ArchiveForms, EmptyArchivesSayWhatTheyLack) {
  for (const char* form : {".7z", ".rar", ".rar5"}) {
    const fs::path path = folder_ / ("a" + std::string(form));
    test::pack_archive(path, {});
    EXPECT_NE(message_of([&] { find_format(path); }).find("the archive holds no .json, "),
              std::string::npos)
        << form << message_of([&] { find_format(path); });
  }
  for (const char* form : {".tar", ".tar.gz", ".tar.xz"}) {
    const fs::path path = folder_ / ("a" + std::string(form));
    test::pack_archive(path, {});
    EXPECT_NE(message_of([&] { find_format(path); }).find("is a tar archive without files"),
              std::string::npos)
        << form << message_of([&] { find_format(path); });
  }
}

}  // namespace
}  // namespace nightcity::inputs
