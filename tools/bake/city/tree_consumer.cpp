#include "tools/bake/city/tree_consumer.h"

namespace nightcity::bake {
namespace {

// Null where the object is a tree or no plant that stands alone.
const char* find_reason(trees::NoTree why) {
  switch (why) {
    case trees::NoTree::low:
      return "low plant";
    case trees::NoTree::wide:
      return "plant too large for one tree";
    case trees::NoTree::nowhere:
    case trees::NoTree::is_one:
    case trees::NoTree::no_plant:
      return nullptr;
  }
  return nullptr;
}

}  // namespace

CityConsumer::Turn TreeConsumer::prepare(const std::shared_ptr<const PreparedObject>& prepared) {
  if (prepared->tree)
    return [this, tree = *prepared->tree](bool continues) {
      if (!continues) trees_.push_back(tree);
    };
  if (const char* reason = find_reason(prepared->no_tree))
    return [this, reason](bool continues) {
      if (!continues) ++surfaces_[reason];
    };
  return {};
}

}  // namespace nightcity::bake
