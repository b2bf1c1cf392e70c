// Photometry in archives and streams. GLDF, the Global Lighting Data Format, is a .zip whose
// product.xml names files of photometry.
#include <algorithm>
#include <array>
#include <filesystem>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/archive_entries.h"
#include "tools/city/byte_source.h"
#include "tools/lights/luminaire.h"
#include "tools/lights/text_lines.h"

namespace nightcity::lights {
namespace {

constexpr std::array<std::string_view, 1> product_endings{"product.xml"};
constexpr std::array<std::string_view, 4> photometry_endings{".ldt", ".ies", ".xml", ".iesxml"};

std::string read_whole(const city::Document& document) {
  return city::read_next(*document.open(), largest_luminaire_file + 1);
}

std::string base_name(const std::string& path) {
  return to_lower(path.substr(path.find_last_of("/\\") + 1));
}

/// Returns the name of the file of the first photometry, and how many photometries there are.
std::pair<std::string, std::size_t> find_photometry(const pugi::xml_node& root,
                                                    const std::string& product) {
  const pugi::xml_node definitions = root.child("GeneralDefinitions");
  std::string id;
  std::size_t count = 0;
  for (const pugi::xml_node& photometry :
       definitions.child("Photometries").children("Photometry")) {
    const char* said = photometry.child("PhotometryFileReference").attribute("fileId").value();
    if (count++ == 0) id = said;
  }
  for (const pugi::xml_node& file : definitions.child("Files").children("File")) {
    if (id.empty() || id != file.attribute("id").value()) continue;
    if (std::string_view(file.attribute("type").value()) == "url")
      throw Error(product, "its photometry lies at an address: fetch the file itself");
    return {file.text().get(), count};
  }
  throw Error(product, "names no file of photometry");
}

Luminaire read_gldf(const std::filesystem::path& file,
                    const std::vector<city::Document>& products) {
  const TextLines product(products.front().name, read_whole(products.front()));
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(
      product.text().data(), product.text().size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed) throw Error(product.file(), std::string("broken XML: ") + parsed.description());
  const auto [name, count] = find_photometry(document.document_element(), product.file());
  for (const city::Document& entry : city::list_documents(file, photometry_endings)) {
    if (base_name(entry.name) != base_name(name)) continue;
    Luminaire luminaire = read_luminaire(TextLines(entry.name, read_whole(entry)));
    if (count > 1)
      luminaire.notes.push_back("the file defines " + std::to_string(count) +
                                " photometries, of which the first is read");
    return luminaire;
  }
  throw Error(product.file(), "names \"" + name.substr(0, 100) +
                                  "\" as photometry, which is not in the archive as .ldt, .ies or "
                                  ".xml");
}

// Reads the one file of photometry in an archive that is no GLDF.
Luminaire read_only_photometry(const std::filesystem::path& file) {
  std::vector<TextLines> found;
  for (const city::Document& entry : city::list_documents(file, photometry_endings)) {
    TextLines lines(entry.name, read_whole(entry));
    const bool may_be_other = to_lower(entry.name).ends_with(".xml");
    if (!may_be_other || begins_as_tm33(lines.text())) found.push_back(std::move(lines));
  }
  if (found.empty())
    throw Error(file.string(), "the archive holds neither photometry nor a product.xml (GLDF)");
  if (found.size() > 1)
    throw Error(file.string(), "the archive holds several files of photometry (" +
                                   base_name(found[0].file()) + ", " + base_name(found[1].file()) +
                                   (found.size() > 2 ? ", ..." : "") +
                                   ") and no product.xml (GLDF) that names one: unpack it and name "
                                   "one of them");
  return read_luminaire(found.front());
}

}  // namespace

Luminaire read_packed_luminaire(const std::filesystem::path& file) {
  if (!city::is_archive_file(file)) {
    const city::Document stream = city::list_documents(file, photometry_endings).front();
    return read_luminaire(TextLines(stream.name, read_whole(stream)));
  }
  std::vector<city::Document> products;
  try {
    products = city::list_documents(file, product_endings);
  } catch (const city::NothingInside&) {
    if (to_lower(file.extension().string()) == ".gldf") throw;
    return read_only_photometry(file);
  }
  return read_gldf(file, products);
}

}  // namespace nightcity::lights
