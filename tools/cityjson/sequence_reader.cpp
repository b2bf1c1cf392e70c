#include "tools/cityjson/sequence_reader.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "formats/error.h"
#include "tools/cityjson/document_text.h"
#include "tools/cityjson/feature_reader.h"
#include "tools/cityjson/sample.h"
#include "tools/in_order.h"

namespace nightcity::cityjson {
namespace {

// Calls `use(line, its number)` for each line that is not blank. The text of a line is followed by
// bytes that simdjson may read.
template <class Use>
void for_each_line(const LineReader::Lines& lines, const Use& use) {
  const std::string_view all = lines.text();
  std::size_t number = lines.first_line;
  for (std::size_t begin = 0; begin < all.size(); ++number) {
    const std::size_t end = std::min(all.find('\n', begin), all.size());
    std::string_view line = all.substr(begin, end - begin);
    if (line.starts_with(record_separator)) line.remove_prefix(1);
    if (line.find_first_not_of(" \t\r") != std::string_view::npos && !use(line, number)) return;
    begin = end + 1;
  }
}

// Takes the line that begins at a byte, and moves `at` behind it.
LineReader::Lines take_line(LineReader::Lines& lines, std::size_t& at) {
  const std::string_view all = lines.text();
  const std::size_t feed = all.find('\n', at), end = feed == all.npos ? all.size() : feed + 1;
  LineReader::Lines one;
  one.first_line = lines.first_line++;
  one.size = end - at;
  one.bytes = std::make_unique<char[]>(one.size + simdjson::SIMDJSON_PADDING);
  std::copy_n(all.data() + at, one.size, one.bytes.get());
  at = end;
  return one;
}

dom::element parse(dom::parser& parser, std::string_view line, const std::string& name,
                   std::size_t number) {
  dom::element value;
  if (const auto error = parse_text(parser, line, value))
    throw Error(name, number, std::string("not JSON: ") + simdjson::error_message(error));
  return value;
}

// The document's first value, which the features refer to.
struct Header {
  dom::parser parser;  // holds what `shared` refers to
  SharedParts shared;
  dom::element value;

  void read(std::string_view line, const std::string& name, std::size_t number,
            city::SkipCounter& skipped) {
    if (const auto error = parse_text(parser, line, value))
      throw Error(name, number,
                  "the first line of a CityJSONSeq holds its CRS and transform, and this one is no "
                  "JSON (" +
                      std::string(simdjson::error_message(error)) + "): fetch the file again");
    const std::string where = name + ":" + std::to_string(number);
    dom::object object;
    if (value.get(object) != simdjson::SUCCESS)
      throw Error(name, number, "is no CityJSON: it is no JSON object");
    for (const auto& [key, member] : object)
      shared.read(
          key, member, [&] { return where; }, skipped);
    shared.require_type(where);
  }
};

class SequenceReader {
 public:
  SequenceReader(const city::Document& document, const city::ReadOptions& options,
                 const city::ObjectStage& stage)
      : document_(document),
        options_(options),
        stage_(stage),
        lines_(document, options.max_member_bytes()) {}

  city::ReadReport read() {
    read_header();
    in_order(
        options_.threads, [&] { return next(); },
        [&](LineReader::Lines&& lines) { return read_lines(lines); },
        [&](Batch&& batch) { batch.take_into(report_); });
    return std::move(report_);
  }

 private:
  void read_header() {
    Batch batch;
    while (!header_line_) {
      first_ = lines_.next();
      if (!first_) throw Error(document_.name, "holds no JSON");
      for_each_line(*first_, [&](std::string_view line, std::size_t number) {
        header_line_ = number;
        header_.read(line, document_.name, number, batch.skipped);
        header_.shared.materials.find_pictures(document_.name, options_, batch.skipped);
        // It should hold no city objects of its own; where it does, they are read too.
        read_feature(header_.value, header_.shared, options_, document_.name, 1, batch);
        return false;
      });
    }
    report_.version = header_.shared.version;
    report_.srs_name = header_.shared.srs_name;
    header_.shared.require_srs_name(options_.srs_name, document_.name);
    batch.hand_over(stage_);
    batch.take_into(report_);
  }

  std::optional<LineReader::Lines> next() {
    if (!options_.passes_one_by_one())
      return first_ ? std::exchange(first_, std::nullopt) : lines_.next();
    if (!first_) first_ = lines_.next();
    if (!first_) return {};
    LineReader::Lines one = take_line(*first_, at_);
    if (at_ == first_->size) {
      first_.reset();
      at_ = 0;
    }
    return one;
  }

  Batch read_lines(const LineReader::Lines& lines) const {
    Batch batch;
    dom::parser parser;
    for_each_line(lines, [&](std::string_view line, std::size_t number) {
      if (number > *header_line_) {
        const dom::element value = parse(parser, line, document_.name, number);
        read_feature(value, header_.shared, options_, document_.name, number, batch);
      }
      return true;
    });
    batch.hand_over(stage_);
    return batch;
  }

  const city::Document& document_;
  const city::ReadOptions& options_;
  const city::ObjectStage& stage_;
  LineReader lines_;
  // The block that begins with the header, or one whose lines are passed on one by one.
  std::optional<LineReader::Lines> first_;
  std::size_t at_ = 0;  // byte of it that the next line begins at
  std::optional<std::size_t> header_line_;
  Header header_;
  city::ReadReport report_;
};

}  // namespace

city::ReadReport read_sequence(const city::Document& document, const city::ReadOptions& options,
                               const city::ObjectStage& stage) {
  return SequenceReader(document, options, stage).read();
}

city::CityHead read_sequence_head(const city::Document& document,
                                  const city::ReadOptions& options) {
  city::CityHead head;
  city::SkipCounter unused;
  Header header;
  dom::parser parser;
  bool has_header = false;
  LineReader reader(document, options.max_member_bytes());
  while (const auto lines = reader.next()) {
    for_each_line(*lines, [&](std::string_view line, std::size_t number) {
      if (!has_header) {
        has_header = true;
        header.read(line, document.name, number, unused);
        return true;
      }
      dom::object feature;
      if (parse(parser, line, document.name, number).get(feature) != simdjson::SUCCESS) return true;
      Sample sample;
      if (const auto objects = find_object(feature, "CityObjects"))
        for (const auto& [id, object] : *objects) sample.add_object(object);
      if (const auto array = find_array(feature, "vertices"))
        sample.take_vertices(read_vertices(*array, header.shared.transform), 0);
      sample.move_to(head);
      return head.sample.size() < enough_points;
    });
    if (head.sample.size() >= enough_points) break;
  }
  head.version = header.shared.version;
  head.srs_name = header.shared.srs_name;
  return head;
}

}  // namespace nightcity::cityjson
