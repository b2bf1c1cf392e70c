#include "tools/citygml/server_answer.h"

#include <pugixml.hpp>

#include "tools/city/attributes.h"
#include "tools/citygml/tag_scanner.h"
#include "tools/citygml/xlinks.h"

namespace nightcity::citygml {

std::string find_what_is_missing(const DocumentHead& head) {
  if (local_name(head.root_name) != "FeatureCollection") return {};
  const std::string text = head.root_tag + "</" + head.root_name + ">";
  pugi::xml_document xml;
  if (!xml.load_buffer(text.data(), text.size())) return {};
  const pugi::xml_node root = xml.document_element();
  const std::string_view all = find_attribute(root, "numberMatched"),
                         given = find_attribute(root, "numberReturned");
  const auto matched = city::parse_number(all), returned = city::parse_number(given);
  const std::string remedy =
      ": ask it for the others (startIndex and count, or the address under \"next\"), and name all "
      "answers";
  if (matched && returned && *matched > *returned)
    return "incomplete: the server gave " + std::string(given) + " of " + std::string(all) +
           " features" + remedy;
  if (!find_attribute(root, "next").empty())
    return "incomplete: the server gave one page of several" + remedy;
  return {};
}

bool is_server_error(std::string_view member) {
  return member == "truncatedResponse" || member == "ExceptionReport" ||
         member == "ServiceExceptionReport";
}

}  // namespace nightcity::citygml
