#include "runtime/experiments/price.h"

#include <algorithm>
#include <cmath>

#include "formats/error.h"
#include "runtime/measure/false_colour.h"

namespace nightcity::experiments {
namespace {

using measure::Estimate;

constexpr const char* bounces_group = "bounces";

// Returns the measure's value with so many standard errors more, at least 0.
double find_bound(ErrorMeasure measure, const measure::ModelDifference& d, double errors) {
  const auto move = [errors](double value, double error) {
    return std::max(std::max(value, 0.0) + errors * error, 0.0);
  };
  switch (measure) {
    case ErrorMeasure::rmse:
      return std::sqrt(move(d.mse8.value, d.mse8.error));
    case ErrorMeasure::mean:
      return move(std::abs(d.relative_mean.value), d.relative_mean.error);
    case ErrorMeasure::relative_rmse:
      return std::sqrt(move(d.relative_mse.value, d.relative_mse.error));
  }
  return 0;
}

double find_mean(const std::vector<measure::Image>& pictures) {
  double sum = 0, count = 0;
  for (const measure::Image& picture : pictures)
    for (const float value : measure::luminance_of(picture)) {
      sum += double{value};
      ++count;
    }
  return sum / count;
}

class Pricing {
 public:
  Pricing(const PriceOptions& options, program::ProgressDisplay& progress)
      : options_(options),
        progress_(progress),
        bench_({options.device, options.width, options.height, options.runs, options.frames,
                options.timed},
               progress) {
    if (options.runs < 3)
      throw UsageError("--runs", "must be 3 or more: the standard errors are by leaving one out");
    report_.device = bench_.device_name();
  }

  PriceReport run() {
    load_whole();
    if (options_.others.empty())
      list_parts();
    else
      list_others();
    bench_.expect(report_.measured.size() + 1);
    find_lamps_seen();
    whole_pictures_ = bench_.render(whole_, "whole model");
    measure_rows();
    if (options_.others.empty()) choose();
    bench_.check_validation();
    return std::move(report_);
  }

 private:
  // Reads the files twice: the first time fills the system's file cache, so that models are
  // compared without it.
  void load_whole() {
    progress_.show({"reading the scene", 0, 0, ""});
    {
      const scene::RenderScene scene = options_.load(options_.left_out.of_scene());
      bench_.set_views(find_views(options_.views, scene), scene);
      report_.triangles = scene.triangles.size();
      report_.lights = scene.lights.size();
      for (const Light& light : scene.lights)
        is_lamp_.push_back(light_kind(light) == LightKind::sphere);
      for (const render::ModelPart& part : render::list_model_parts())
        counts_.push_back(count_of(part, scene));
    }
    for (const View& view : bench_.views()) report_.views.push_back(view.name);
    whole_ = bench_.load(options_.load, options_.left_out, options_.settings);
    report_.whole.bytes = double(whole_.scene->bytes());
    report_.whole.load_s = whole_.load_s;
  }

  std::size_t count_of(const render::ModelPart& part, const scene::RenderScene& scene) const {
    if (options_.left_out.holds(part)) return 0;
    if (part.of_scene) return scene.parts[static_cast<std::size_t>(*part.of_scene)];
    return render::is_present(part, scene, options_.settings) ? 1 : 0;
  }

  // Returns a row that differs in nothing from the whole model.
  SimplerModel make_row() const {
    SimplerModel row;
    row.left_out = options_.left_out;
    row.bounces = options_.settings.indirect.bounces;
    return row;
  }

  void add(SimplerModel row) {
    if (row.count > 0) report_.measured.push_back(report_.rows.size());
    report_.rows.push_back(std::move(row));
  }

  // One row for each part, and one for each number of bounces below that of the whole model.
  void list_parts() {
    const auto& parts = render::list_model_parts();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (std::string(parts[i].name) == bounces_group) continue;
      SimplerModel row = make_row();
      row.name = parts[i].name;
      row.help = parts[i].help;
      row.count = counts_[i];
      row.left_out.add(parts[i]);
      add(std::move(row));
    }
    const std::uint32_t bounces = options_.settings.indirect.bounces;
    for (std::uint32_t fewer = 0; fewer < std::max(bounces, 1u); ++fewer) {
      SimplerModel row = make_row();
      row.name = std::string(bounces_group) + " " + std::to_string(fewer);
      row.help = fewer == 0 ? "direct light alone" : "no light that bounces more often";
      row.count = bounces;
      row.bounces = fewer;
      add(std::move(row));
    }
  }

  void list_others() {
    for (const auto& [name, read] : options_.others) {
      SimplerModel row = make_row();
      row.name = name;
      row.help = "another bake";
      row.count = 1;
      add(std::move(row));
    }
  }

  Model load(const SimplerModel& row, const LoadWithout& read) {
    render::RenderSettings settings = options_.settings;
    settings.indirect.bounces = std::min(settings.indirect.bounces, row.bounces);
    return bench_.load(read, row.left_out, settings);
  }

  void set_errors(SimplerModel& row) const {
    row.error = row.least = row.bound = 0;
    for (const measure::ModelDifference& difference : row.views) {
      row.error = std::max(row.error, value_of(options_.measure, difference).value);
      row.least = std::max(row.least, find_bound(options_.measure, difference, -2));
      row.bound = std::max(row.bound, find_bound(options_.measure, difference, 2));
    }
  }

  void set_cost(SimplerModel& row, Model& model) {
    row.saved.ms = bench_.time_difference(whole_, model, whole_ms_);
    row.saved.bytes = report_.whole.bytes - double(model.scene->bytes());
    row.saved.load_s = report_.whole.load_s - model.load_s;
  }

  void measure_rows() {
    for (std::size_t i = 0; i < report_.measured.size(); ++i) {
      SimplerModel& row = report_.rows[report_.measured[i]];
      Model model = load(row, options_.others.empty() ? options_.load : options_.others[i].second);
      compare(row, bench_.render(model, row.name), whole_pictures_);
      set_errors(row);
      set_cost(row, model);
    }
    report_.whole.ms = find_median(whole_ms_);
    for (const std::vector<measure::Image>& view : whole_pictures_)
      report_.means.push_back(find_mean(view));
    for (const std::size_t row : report_.measured)
      report_.rows[row].saving = find_saving(report_.rows[row].saved, report_.whole);
  }

  void find_lamps_seen() {
    lamps_seen_ = bench_.find_seen(whole_, is_lamp_);
    for (const std::vector<bool>& view : lamps_seen_)
      report_.lamps_seen.push_back(double(std::count(view.begin(), view.end(), true)) /
                                   double(view.size()));
  }

  // Compares pictures of a model with those of the whole one. Where a part is missing without which
  // lamps look otherwise, pixels that see one do not count.
  void compare(SimplerModel& row, const Pictures& pictures, const Pictures& whole) const {
    for (const render::ModelPart& part : render::list_model_parts())
      row.without_lamps_seen |=
          part.changes_lamps_seen && row.left_out.holds(part) && !options_.left_out.holds(part);
    row.views = bench_.compare(
        pictures, whole, row.without_lamps_seen ? lamps_seen_ : std::vector<std::vector<bool>>());
  }

  SimplerModel combine(const std::vector<std::size_t>& cuts) const {
    SimplerModel model = make_row();
    for (const std::size_t cut : cuts) {
      const SimplerModel& row = report_.rows[report_.measured[cut]];
      model.name += (model.name.empty() ? "" : ", ") + row.name;
      for (const render::ModelPart& part : render::list_model_parts())
        if (row.left_out.holds(part)) model.left_out.add(part);
      model.bounces = std::min(model.bounces, row.bounces);
    }
    return model;
  }

  // Measures a set of cuts. A verification renders the whole model anew as well.
  double measure_cuts(const std::vector<std::size_t>& cuts, bool is_verification) {
    bench_.expect(is_verification ? 2 : 1);
    SimplerModel row = combine(cuts);
    Model model = load(row, options_.load);
    const Pictures pictures = bench_.render(model, is_verification ? "verifying" : "trying");
    compare(row, pictures, is_verification ? bench_.render(whole_, "verifying") : whole_pictures_);
    set_errors(row);
    if (is_verification) {
      set_cost(row, model);
      row.saving = find_saving(row.saved, report_.whole);
      report_.chosen = row;
    }
    return row.bound;
  }

  void choose() {
    std::vector<Cut> cuts;
    for (const std::size_t row : report_.measured) {
      const SimplerModel& each = report_.rows[row];
      cuts.push_back(
          {each.name.starts_with(bounces_group) ? bounces_group : "", each.error, each.saving});
    }
    report_.choice = choose_cuts(cuts, options_.limit, [this](const auto& made, bool verifies) {
      return measure_cuts(made, verifies);
    });
    if (report_.choice.cuts.empty()) report_.chosen = make_row();
  }

  const PriceOptions& options_;
  program::ProgressDisplay& progress_;
  ModelBench bench_;
  PriceReport report_;
  std::vector<std::size_t> counts_;  // parallel to the table of parts
  Model whole_;
  Pictures whole_pictures_;
  std::vector<bool> is_lamp_;                  // by number of the light
  std::vector<std::vector<bool>> lamps_seen_;  // pixels of each view
  std::vector<double> whole_ms_;
};

}  // namespace

Estimate value_of(ErrorMeasure measure, const measure::ModelDifference& difference) {
  switch (measure) {
    case ErrorMeasure::rmse:
      return difference.rmse8();
    case ErrorMeasure::mean:
      return {std::abs(difference.relative_mean.value), difference.relative_mean.error};
    case ErrorMeasure::relative_rmse:
      return measure::root_of(difference.relative_mse);
  }
  return {};
}

double find_saving(const ModelCost& saved, const ModelCost& whole) {
  const bool is_measured = std::abs(saved.ms.value) > 2 * saved.ms.error;
  const double of_ms = is_measured && whole.ms.value > 0 ? saved.ms.value / whole.ms.value : 0;
  const double of_bytes = whole.bytes > 0 ? saved.bytes / whole.bytes : 0;
  return 0.5 * (of_ms + of_bytes);
}

PriceReport price_scene(const PriceOptions& options, program::ProgressDisplay& progress) {
  return Pricing(options, progress).run();
}

}  // namespace nightcity::experiments
