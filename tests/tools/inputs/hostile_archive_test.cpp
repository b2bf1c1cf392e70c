// Archives and streams that are cut off, damaged, encrypted or made to fill the disk.
#include <gtest/gtest.h>

#include <string>

#include "formats/error.h"
#include "support/error_message.h"
#include "support/pack_archive.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/city/archive_entries.h"
#include "tools/inputs/file_format.h"
#include "tools/inputs/read_city.h"

namespace nightcity::inputs {
namespace {

namespace fs = std::filesystem;
using test::make_archive;

class HostileArchive : public testing::Test {
 protected:
  // Returns what is said of a file, and how many objects came before.
  std::string why_not(const std::string& name, const std::string& bytes) {
    objects_ = 0;
    test::write_text(folder_ / name, bytes);
    return test::message_of(
        [&] { read_city(folder_ / name, {}, [&](city::CityObject&&) { ++objects_; }); },
        "was read");
  }
  void expect(const std::string& name, const std::string& bytes, const std::string& words) {
    const std::string said = why_not(name, bytes);
    EXPECT_NE(said.find(words), std::string::npos) << name << ": " << said;
    EXPECT_NE(said.find((folder_ / name).string()), std::string::npos) << said;
  }

  // It has a size that no form packs into less than some hundred bytes.
  static test::ZipFiles two_houses() {
    const std::string a = test::city_model(test::member(test::building("a")));
    std::string noise;
    for (unsigned i = 0, seed = 1; i < 20'000; ++i)
      noise += static_cast<char>((seed = seed * 1664525 + 1013904223) >> 24);
    return {{"a.gml", a}, {"noise.bin", noise}, {"b.gml", a}};
  }
  test::TempFolder folder_;
  std::size_t objects_ = 0;
};

TEST_F(HostileArchive, WhatIsCutOffIsBrokenWhereverItIsCut) {
  for (const std::string form : {".tar", ".tar.gz", ".tar.bz2", ".tar.xz", ".tar.zst", ".tar.lzma",
                                 ".tar.lz4", ".tar.lz", ".tar.Z", ".7z", ".rar", ".rar5"}) {
    const std::string whole = make_archive(form, two_houses());
    EXPECT_EQ(why_not("a" + form, whole), "was read") << form;
    // libarchive's tar ends with 10 kB of zeros, and a stored archive with a mark of 7 bytes.
    const std::size_t end = form == ".tar" ? whole.size() - 9300 : whole.size() - 9;
    for (const std::size_t size : {whole.size() / 3, whole.size() / 2, whole.size() * 2 / 3, end}) {
      // The others end with sums and marks; compress ends with zeros.
      if (size > end || (form == ".tar.Z" && size == end)) continue;
      expect("a" + form, whole.substr(0, size), "broken");
      EXPECT_EQ(objects_, 0u) << form << size;
    }
  }
}

// Between two entries nothing shows it but the mark of the end.
TEST_F(HostileArchive, ATarThatIsCutOffBetweenEntriesIsBroken) {
  const std::string whole =
      make_archive(".tar", {{"a.gml", two_houses()[0].second}, {"b.gml", two_houses()[0].second}});
  const std::size_t second = whole.find("b.gml");
  ASSERT_EQ(second % 512, 0u);
  expect("a.tar", whole.substr(0, second), "it has no end, as if cut off");
  EXPECT_EQ(objects_, 0u);
}

TEST_F(HostileArchive, ByteThatIsChangedIsFoundBySums) {
  for (const std::string form :
       {".tar.gz", ".tar.bz2", ".tar.xz", ".tar.lz4", ".tar.lz", ".7z", ".rar", ".rar5"}) {
    std::string bytes = make_archive(form, two_houses());
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x10);
    expect("a" + form, bytes, "broken");
    EXPECT_EQ(objects_, 0u) << form;
  }
}

TEST_F(HostileArchive, StreamsThatAreCutOffAreBroken) {
  for (const std::string form : test::stream_forms) {
    test::pack_stream(folder_ / ("a.gml" + form), two_houses()[1].second);
    const std::string whole = test::read_text(folder_ / ("a.gml" + form));
    for (const std::size_t size : {whole.size() / 2, whole.size() - 1}) {
      test::write_text(folder_ / ("b.gml" + form), whole.substr(0, size));
      const std::string said = test::message_of(
          [&] {
            const auto document = city::list_documents(folder_ / ("b.gml" + form), {}).front();
            city::read_next(*document.open(), std::size_t{1} << 20);
          },
          "was read");
      // The end mark of lz4 and the last padding byte are all that is missing.
      EXPECT_NE(said.find("broken"), std::string::npos) << form << " " << size << ": " << said;
    }
  }
}

TEST_F(HostileArchive, WhatIsEncryptedIsSaidToBe) {
  const test::ZipFiles files = two_houses();
  expect("files.7z", test::make_encrypted_7z("a.gml", files[0].second),
         "a.gml: is encrypted with a password");
  expect("headers.rar", test::make_rar4(files, 0x80), "encrypted");
  expect("files.rar", test::make_rar4(files, 0, 0x04), "is encrypted with a password");
}

TEST_F(HostileArchive, VolumesAreToldTheRemedy) {
  const test::ZipFiles files = two_houses();
  const std::string seven = make_archive(".7z", files), zip = make_archive(".zip", files);
  expect("a.part1.rar", test::make_rar4(files, 1), "is one of several volumes");
  expect("a.rar", test::make_rar4(files, 1), "is one of several volumes");
  expect("b.rar", test::make_rar5(files, 1), "is one of several volumes");
  expect("a.7z.001", seven.substr(0, seven.size() / 2), "is one of several volumes");
  expect("a.zip.001", zip.substr(0, zip.size() / 2), "is one of several volumes");
  expect("a.7z.002", seven.substr(seven.size() / 2), "is one of several volumes");
}

TEST_F(HostileArchive, UnknownMethodsAreToldTheRemedy) {
  expect("a.rar", test::make_rar5(two_houses(), 0, 7), "unpack it yourself");
}

TEST_F(HostileArchive, FilesOfOtherKindsUnderTheirNamesAreTold) {
  expect("a.7z", "hello", "is named as an archive and is none");
  expect("a.tar.gz", "<!DOCTYPE html><html><body/></html>", "is a web page");
  expect("a.rar", std::string("Rar!\x1A\x07\x01") + std::string(40, '\0'), "a.rar");
  expect("a.7z", std::string("7z\xBC\xAF\x27\x1C") + std::string(40, '\0'), "a.7z");
}

// A gigabyte of zeros in some kilobytes.
TEST_F(HostileArchive, BombsEndAtTheLimit) {
  const std::string megabyte(std::size_t{1} << 20, '\0');
  const auto write = [&](const fs::path& path, int format, auto begin) {
    archive* const out = archive_write_new();
    archive_write_set_format(out, format);
    test::add_filter(out, path.native());
    archive_write_open_filename(out, path.c_str());
    archive_entry* const entry = archive_entry_new();
    archive_entry_set_pathname(entry, "a.gml");
    archive_entry_set_filetype(entry, AE_IFREG);
    archive_entry_set_size(entry, la_int64_t{1100} << 20);
    begin(entry);
    archive_write_header(out, entry);
    for (int i = 0; i < 1100; ++i) archive_write_data(out, megabyte.data(), megabyte.size());
    archive_entry_free(entry);
    archive_write_close(out);
    archive_write_free(out);
  };
  const auto plain = [](archive_entry*) {};
  const auto sparse = [](archive_entry* entry) { archive_entry_sparse_add_entry(entry, 0, 1); };
  const auto why = [&](const char* name) {
    return test::message_of([&] { read_city(folder_ / name, {}, [](city::CityObject&&) {}); },
                            "was read");
  };
  write(folder_ / "a.tar.zst", ARCHIVE_FORMAT_TAR_USTAR, plain);
  write(folder_ / "sparse.tar", ARCHIVE_FORMAT_TAR_PAX_RESTRICTED, sparse);
  EXPECT_LT(fs::file_size(folder_ / "a.tar.zst"), 200'000u);
  EXPECT_LT(fs::file_size(folder_ / "sparse.tar"), 200'000u);
  for (const char* name : {"a.tar.zst", "sparse.tar"})
    EXPECT_NE(why(name).find("unpacks to more than 200 times"), std::string::npos) << why(name);
  // The same in another archive.
  test::pack_archive(folder_ / "outer.tar",
                     {{"in.tar.zst", test::read_text(folder_ / "a.tar.zst")}});
  EXPECT_NE(why("outer.tar").find("unpacks to more than 200 times"), std::string::npos);
}

TEST_F(HostileArchive, AHundredThousandEntriesAreListedInTheirOrder) {
  test::ZipFiles files;
  for (int i = 0; i < 100'000; ++i) files.emplace_back("d/" + std::to_string(i) + ".txt", "x");
  files.emplace_back("a.gml", two_houses()[0].second);
  for (const std::string form : {".tar", ".7z"}) {
    test::pack_archive(folder_ / ("a" + form), files);
    const auto listing = city::list_archive(folder_ / ("a" + form));
    ASSERT_EQ(listing->entries.size(), 100'001u);
    EXPECT_EQ(listing->entries[77'777].inside, "d/77777.txt");
    EXPECT_EQ(city::read_next(*listing->entries[77'777].open(""), 9), "x");
  }
}

}  // namespace
}  // namespace nightcity::inputs
