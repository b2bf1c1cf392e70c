// The trees of a city model, gathered while it is read.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tools/bake/city/city_consumer.h"
#include "tools/trees/model_tree.h"

namespace nightcity::bake {

class TreeConsumer final : public CityConsumer {
 public:
  Turn prepare(const std::shared_ptr<const PreparedObject>& prepared) override;

  const std::vector<trees::ModelTree>& trees() const { return trees_; }
  /// Plants that are no trees, by reason: they stay the surfaces that the model has.
  const std::map<std::string, std::size_t>& surfaces() const { return surfaces_; }

 private:
  std::vector<trees::ModelTree> trees_;
  std::map<std::string, std::size_t> surfaces_;
};

}  // namespace nightcity::bake
