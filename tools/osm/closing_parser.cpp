#include "tools/osm/closing_parser.h"

#include <osmium/io/pbf_input.hpp>

#include <unistd.h>

#include <exception>
#include <future>
#include <memory>
#include <utility>

namespace nightcity::osm {
namespace {

using osmium::io::detail::Parser;
using osmium::io::detail::parser_arguments;

// Has the work done by libosmium's parser, and hands on itself what that throws: the base class
// would tell the reader a second time about a header that was read.
class ClosingParser final : public Parser {
 public:
  explicit ClosingParser(parser_arguments& arguments)
      : Parser(arguments), arguments_(arguments), parser_(arguments) {}

  void run() override {
    try {
      parser_.run();
    } catch (...) {
      if (arguments_.fd > STDERR_FILENO) ::close(arguments_.fd);
      pass_on(std::current_exception());
    }
  }

 private:
  void pass_on(std::exception_ptr exception) {
    try {
      arguments_.header_promise.set_exception(exception);
    } catch (const std::future_error&) {  // the header was sound
    }
    osmium::io::detail::add_to_queue(arguments_.output_queue, std::move(exception));
  }

  parser_arguments& arguments_;
  osmium::io::detail::PBFParser parser_;
};

}  // namespace

void close_broken_maps() {
  [[maybe_unused]] static const bool registered =
      osmium::io::detail::ParserFactory::instance().register_parser(
          osmium::io::file_format::pbf, [](parser_arguments& arguments) -> std::unique_ptr<Parser> {
            return std::make_unique<ClosingParser>(arguments);
          });
}

}  // namespace nightcity::osm
