#include "tools/citygml/rings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "tools/citygml/curves.h"
#include "tools/citygml/number_list.h"
#include "tools/citygml/tag_scanner.h"
#include "tools/decimal.h"

namespace nightcity::citygml {
namespace {

bool parse_numbers(const char* at, const char* end, std::vector<double>& numbers) {
  for (;;) {
    while (at < end && is_space(*at)) ++at;
    if (at == end) return true;
    if (*at == '+') ++at;
    double value = 0;
    const auto [rest, error] = parse_decimal(at, end, value);
    if (error != std::errc() || !std::isfinite(value) || (rest < end && !is_space(*rest)))
      return false;
    numbers.push_back(value);
    at = rest;
  }
}

bool append_vertices(const std::vector<double>& numbers, int dimension, city::Ring& ring) {
  const auto d = static_cast<std::size_t>(dimension);
  if (numbers.size() % d != 0) return false;
  ring.reserve(ring.size() + numbers.size() / d);
  for (std::size_t i = 0; i < numbers.size(); i += d) {
    const glm::dvec3 p{numbers[i], numbers[i + 1], d == 3 ? numbers[i + 2] : 0.0};
    if (ring.empty() || ring.back() != p) ring.push_back(p);
  }
  return true;
}

// GML 2's <coordinates>: "x,y,z x,y,z", with separators given by attributes. Blanks around a
// separator say nothing.
class Coordinates {
 public:
  explicit Coordinates(const pugi::xml_node& element) {
    const auto said = [&](const char* name, char standard) {
      const char* value = element.attribute(name).value();
      return *value ? *value : standard;
    };
    decimal_ = said("decimal", '.'), within_ = said("cs", ','), between_ = said("ts", ' ');
    for (const pugi::xml_node& part : element.children()) text_ += part.value();
  }

  RingFault read(city::Ring& ring) {
    std::vector<double> tuple;
    for (Next next = skip_separator(); next != Next::end; next = skip_separator()) {
      if (next == Next::tuple && !tuple.empty() && !end_tuple(tuple, ring))
        return RingFault::wrong_count;
      if (!parse_numbers_in(take_word(), tuple)) return RingFault::not_numbers;
    }
    return tuple.empty() || end_tuple(tuple, ring) ? RingFault::none : RingFault::wrong_count;
  }

 private:
  enum class Next { number, tuple, end };

  // Passes blanks and separators, and tells what stands behind them: a further number of the same
  // tuple, the first one of another, or nothing.
  Next skip_separator() {
    bool within = false, between = at_ == 0, blank = false;
    for (; at_ < text_.size() && is_separator(text_[at_]); ++at_) {
      const char c = text_[at_];
      within = within || (c == within_ && !is_space(c));
      between = between || (c == between_ && !is_space(c));
      blank = blank || is_space(c);
    }
    if (at_ == text_.size()) return Next::end;
    // A blank separates what no other separator does.
    const bool splits = between || (blank && !within && !is_space(within_));
    return splits ? Next::tuple : Next::number;
  }

  bool is_separator(char c) const { return c == within_ || c == between_ || is_space(c); }

  std::string take_word() {
    std::string word;
    for (; at_ < text_.size() && !is_separator(text_[at_]); ++at_)
      word += text_[at_] == decimal_ ? '.' : text_[at_];
    return word;
  }

  static bool parse_numbers_in(const std::string& word, std::vector<double>& tuple) {
    return parse_numbers(word.data(), word.data() + word.size(), tuple);
  }

  static bool end_tuple(std::vector<double>& tuple, city::Ring& ring) {
    if (tuple.size() != 2 && tuple.size() != 3) return false;
    append_vertices(tuple, static_cast<int>(tuple.size()), ring);
    tuple.clear();
    return true;
  }

  std::string text_;
  std::size_t at_ = 0;
  char decimal_, within_, between_;
};

// GML 2's <coord><X>1</X><Y>2</Y><Z>3</Z></coord>.
RingFault read_coord(const pugi::xml_node& element, city::Ring& ring) {
  std::vector<double> numbers;
  for (const pugi::xml_node& axis : element.children())
    if (axis.type() == pugi::node_element && !read_numbers(axis, numbers))
      return RingFault::not_numbers;
  if (numbers.size() != 2 && numbers.size() != 3) return RingFault::wrong_count;
  append_vertices(numbers, static_cast<int>(numbers.size()), ring);
  return RingFault::none;
}

// Returns the dimension of a list of coordinates that names none. Rings are closed, so one that is
// closed in the plane alone has coordinates in the plane, although most of CityGML's have three.
int guess_dimension(const std::vector<double>& numbers) {
  const std::size_t n = numbers.size();
  const auto is_closed = [&](std::size_t d) {
    return n % d == 0 && n >= 4 * d &&
           std::equal(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(d),
                      numbers.end() - static_cast<std::ptrdiff_t>(d));
  };
  return is_closed(2) && !is_closed(3) ? 2 : 3;
}

}  // namespace

const char* name_of(RingFault fault) {
  switch (fault) {
    case RingFault::none:
      break;
    case RingFault::no_coordinates:
      return "ring without coordinates";
    case RingFault::not_numbers:
      return "ring with coordinates that are no numbers";
    case RingFault::wrong_count:
      return "ring with an incomplete vertex";
    case RingFault::too_short:
      return "ring of fewer than three vertices";
    case RingFault::unknown_curve:
      return "ring of curves that are not read (splines, arcs by centre, xlinks)";
  }
  return "sound ring";
}

bool read_numbers(const pugi::xml_node& element, std::vector<double>& numbers) {
  const pugi::xml_node first = element.first_child();
  std::string joined;
  std::string_view text = first.value();
  if (first.next_sibling()) {  // comments and CDATA cut a text, in the middle of numbers too
    for (const pugi::xml_node& part : element.children()) joined += part.value();
    text = joined;
  }
  const std::size_t before = numbers.size();
  if (parse_numbers(text.data(), text.data() + text.size(), numbers)) return true;
  numbers.resize(before);
  const std::string mended = mend_number_list(text);
  return parse_numbers(mended.data(), mended.data() + mended.size(), numbers);
}

int find_dimension(const pugi::xml_node& element, int inherited) {
  const pugi::xml_attribute said = element.attribute("srsDimension");
  return said ? said.as_int() : inherited;
}

RingFault read_vertices(const pugi::xml_node& element, int dimension, city::Ring& vertices) {
  const int inherited = find_dimension(element, dimension);
  thread_local std::vector<double> numbers;  // allocated once per thread, not once per ring
  bool any = false;
  for (const pugi::xml_node& child : element.children()) {
    const std::string_view name = local_name(child.name());
    pugi::xml_node holder = child;
    if (name == "pointProperty" || name == "pointRep") holder = child.first_child().first_child();
    const std::string_view kind = local_name(holder.name());
    if (kind == "coordinates") {
      any = true;
      if (const RingFault fault = Coordinates(holder).read(vertices); fault != RingFault::none)
        return fault;
    } else if (kind == "coord") {
      any = true;
      if (const RingFault fault = read_coord(holder, vertices); fault != RingFault::none)
        return fault;
    } else if (kind == "posList" || kind == "pos") {
      any = true;
      numbers.clear();
      if (!read_numbers(holder, numbers)) return RingFault::not_numbers;
      const int said = find_dimension(holder, inherited);
      const int found = kind == "pos" && numbers.size() == 2 ? 2
                        : said == 0 && kind == "posList"     ? guess_dimension(numbers)
                        : said == 2                          ? 2
                                                             : 3;
      if (!append_vertices(numbers, found, vertices)) return RingFault::wrong_count;
    }
  }
  return any ? RingFault::none : RingFault::no_coordinates;
}

RingFault read_ring(const pugi::xml_node& linear_ring, int dimension, city::Ring& ring) {
  ring.clear();
  const bool of_curves = is_curve_ring(local_name(linear_ring.name()));
  const RingFault fault = of_curves ? read_curves(linear_ring, dimension, ring)
                                    : read_vertices(linear_ring, dimension, ring);
  if (fault != RingFault::none) return fault;
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  return ring.size() < 3 ? RingFault::too_short : RingFault::none;
}

}  // namespace nightcity::citygml
