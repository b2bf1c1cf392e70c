// ANSI/IES TM-33-18 and -22 (ATLA S001, UNI 11733): an XML document whose emitters list candela,
// each with its horizontal and vertical angle.
#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/attributes.h"
#include "tools/city/foreign_format.h"
#include "tools/lights/ies_table.h"
#include "tools/lights/luminaire.h"
#include "tools/lights/text_lines.h"
#include "tools/lights/tm33_opening.h"
#include "tools/lights/tm33_xml.h"

namespace nightcity::lights {
namespace {

using Angles = std::pair<double, double>;  // horizontal, vertical

bool holds_candela(const pugi::xml_node& node) {
  return local_name(node) == "IntData" || local_name(node) == "IntensityData";
}

/// Returns whether what an element lists may be candela: in others of the same form the edition of
/// 2022 has watts, photons, spectra and colours.
bool may_be_luminous(const pugi::xml_node& node) {
  const std::string_view name = local_name(node);
  for (const char* other : {"Radiant", "Photon", "Spectral", "Angular"})
    if (name.starts_with(other)) return false;
  return true;
}

/// Returns the element that lists an emitter's candela: a child, or LuminousIntensity in
/// LuminousData.
pugi::xml_node find_distribution(const pugi::xml_node& emitter) {
  const auto is_distribution = [](const pugi::xml_node& node) {
    return may_be_luminous(node) && node.find_child(holds_candela);
  };
  for (const pugi::xml_node& child : emitter.children()) {
    if (is_distribution(child)) return child;
    if (may_be_luminous(child))
      if (const pugi::xml_node inner = child.find_child(is_distribution)) return inner;
  }
  return {};
}

class Reader {
 public:
  Reader(const TextLines& lines, const pugi::xml_node& root) : lines_(lines), root_(root) {}

  Luminaire read() {
    const pugi::xml_node header = find_child(root_, "Header");
    luminaire_.manufacturer = text_of(header, "Manufacturer");
    luminaire_.name = text_of(header, "Description");
    if (luminaire_.name.empty()) luminaire_.name = text_of(header, "CatalogNumber");
    for (const pugi::xml_node& emitter : root_.children())
      if (local_name(emitter) == "Emitter") {
        add(emitter);
        opening_.add(emitter);
      }
    opening_.give(luminaire_);
    if (candela_.empty()) lines_.fail(1, "no emitter of this TM-33 document lists its intensities");
    make_table();
    luminaire_.grid = unfold_table(lines_, table_);
    luminaire_.flux_lm = integrated_flux(luminaire_.grid);
    if (!(luminaire_.flux_lm > 0)) lines_.fail(table_.last_line, "the luminaire gives no light");
    // As in LM-63: RP-8's lateral angle 0 faces the street.
    luminaire_.street_side_degrees = table_.type == 1 ? guess_street_side(luminaire_.grid, 0) : 0;
    return std::move(luminaire_);
  }

 private:
  std::size_t line_of(const pugi::xml_node& node) const {
    return lines_.find_line(
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, node.offset_debug())));
  }

  double number(const char* text, std::size_t line, std::string_view what) const {
    return lines_.number(city::trim(text), line, what);
  }

  /// Adds the light of an emitter, where it lists some, to that of the others.
  void add(const pugi::xml_node& emitter) {
    const pugi::xml_node distribution = find_distribution(emitter);
    if (!distribution) return;
    const std::size_t line = line_of(distribution);
    read_type(distribution, line);
    if (const std::string lumens = text_of(emitter, "RatedLumens"); !lumens.empty())
      luminaire_.stated_flux_lm += std::max(0.0, number(lumens.c_str(), line, "RatedLumens"));
    if (const std::string quantity = text_of(emitter, "Quantity");
        !quantity.empty() && quantity != "1")
      luminaire_.notes.push_back("its intensities are taken as those of all " + quantity +
                                 " emitters of a kind together");
    const std::string factor = text_of(distribution, "Multiplier");
    const double scale = factor.empty() ? 1 : number(factor.c_str(), line, "Multiplier");
    if (!(scale > 0)) lines_.fail(line, "the multiplier must be above zero");
    std::map<Angles, double> own;
    for (const pugi::xml_node& point : distribution.children())
      if (holds_candela(point)) add(point, scale, own);
    const bool is_first = candela_.empty();
    for (const auto& [angles, candela] : own) candela_[angles] += candela;
    if (!is_first && candela_.size() != own.size())
      lines_.fail(line, "emitters whose intensities are at different angles");
  }

  void read_type(const pugi::xml_node& distribution, std::size_t line) {
    const std::string metric = text_of(distribution, "Metric"),
                      own_type = to_lower(text_of(distribution, "PhotometryType")),
                      type = own_type.empty() ? find_device_type() : own_type;
    if (!metric.empty() && to_lower(metric) != "luminous")
      lines_.fail(line, "the intensities are of the metric \"" + metric.substr(0, 40) +
                            "\": only luminous ones are light in candela");
    const char letter = type.empty() ? 'c' : type.back();  // "C", "CIE-C", "CIE _ C"
    if (letter < 'a' || letter > 'c')
      lines_.fail(line, "\"" + type.substr(0, 40) + "\" is no type of photometry (A, B or C)");
    const int read = letter == 'c' ? 1 : letter == 'b' ? 2 : 3;
    if (!candela_.empty() && read != table_.type)
      lines_.fail(line, "emitters of different types of photometry");
    table_.type = read;
    if (table_.last_line == 0) table_.vertical_line = table_.horizontal_line = line;
    table_.last_line = line;
  }

  /// Returns the type by the device that measured, which the standard's schema has in place of one
  /// beside the candela.
  std::string find_device_type() const {
    const pugi::xml_node equipment = find_child(root_, "Equipment");
    for (const char* device : {"Gonioradiometer", "Goniometer"})
      if (const std::string type = text_of(find_child(equipment, device), "Type");
          !type.empty() && to_lower(type) != "custom")
        return to_lower(type);
    return {};
  }

  void add(const pugi::xml_node& point, double scale, std::map<Angles, double>& own) const {
    const auto angle = [&](const char* brief, const char* full) {
      const pugi::xml_attribute is_brief = point.attribute(brief);
      const pugi::xml_attribute said = is_brief ? is_brief : point.attribute(full);
      return number(said.value(), line_of(point), full);
    };
    const Angles angles{angle("h", "horz"), angle("v", "vert")};
    const double candela = number(point.text().get(), line_of(point), "candela values");
    if (candela < 0) lines_.fail(line_of(point), "negative candela");
    if (!own.emplace(angles, candela * scale).second)
      lines_.fail(line_of(point), "the intensity at " + name(angles) + " is given twice");
  }

  static std::string name(const Angles& angles) {
    const auto brief = [](double degrees) {
      std::string text = std::to_string(degrees);
      text.resize(text.find_last_not_of('0') + 1);
      return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
    };
    return "h = " + brief(angles.first) + ", v = " + brief(angles.second);
  }

  /// Brings the points, which are in order of their angles, into rows.
  void make_table() {
    for (const auto& [angles, candela] : candela_) {
      if (table_.horizontal.empty() || table_.horizontal.back() != angles.first)
        table_.horizontal.push_back(angles.first);
      table_.vertical.push_back(angles.second);
    }
    std::sort(table_.vertical.begin(), table_.vertical.end());
    table_.vertical.erase(std::unique(table_.vertical.begin(), table_.vertical.end()),
                          table_.vertical.end());
    if (table_.vertical.size() < 2)
      lines_.fail(table_.last_line, "one vertical angle does not say where the light goes");
    const std::size_t largest = 4'000'000;
    if (table_.horizontal.size() * table_.vertical.size() > largest)
      lines_.fail(table_.last_line, "more angles than any file has");
    for (const double h : table_.horizontal)
      for (const double v : table_.vertical) {
        const auto found = candela_.find({h, v});
        if (found == candela_.end())
          lines_.fail(table_.last_line, "no intensity at " + name({h, v}));
        table_.candela.push_back(found->second);
      }
  }

  const TextLines& lines_;
  pugi::xml_node root_;
  Luminaire luminaire_;
  std::map<Angles, double> candela_;
  IesTable table_;
  Tm33Opening opening_{lines_};
};

}  // namespace

bool begins_as_tm33(std::string_view text) {
  const std::string root = to_lower(city::find_root_name(text));
  return root.starts_with("iestm33") || root == "luminaireopticaldata";
}

Luminaire read_tm33(const TextLines& lines) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(
      lines.text().data(), lines.text().size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed) throw Error(lines.file(), std::string("broken XML: ") + parsed.description());
  return Reader(lines, document.document_element()).read();
}

}  // namespace nightcity::lights
