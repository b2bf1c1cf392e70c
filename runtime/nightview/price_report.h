// The options of `nightview price`, and the tables and JSON of its results.
#pragma once

#include <string>
#include <vector>

#include "runtime/experiments/price.h"
#include "runtime/nightview/render_options.h"

namespace nightcity::nightview {

struct PriceCommand {
  RenderOptions render;
  experiments::PriceOptions price;
  std::string views, measure = "rmse", out;
  std::vector<std::string> against;
  bool json = false;
};

/// Prints a table, and below it what was absent, undecided and chosen.
void print_as_table(const PriceCommand& command, const experiments::PriceReport& report);
/// Prints the same as JSON.
void print_as_json(const PriceCommand& command, const experiments::PriceReport& report);

}  // namespace nightcity::nightview
