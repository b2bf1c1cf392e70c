#include "tools/bake/city/object_versions.h"

#include <algorithm>

#include "formats/checksum.h"
#include "tools/city/better_level.h"

namespace nightcity::bake {
namespace {

// The files may use one id for so many objects, each in its place; further ones are known by their
// first vertex alone, since each is compared with all before it.
constexpr std::size_t max_places = 32;
// So often a city is read anew: each round finds all that the order of its files hides, but for
// chains of versions of which each covers a different half of the one before.
constexpr int max_rounds = 2;

constexpr const char* worse = "in a lower level of detail than the same elsewhere";
constexpr const char* part_of_other = "part of an object in another file that links to it";

std::uint64_t make_key(const ObjectVersion& version) {
  const std::array<std::uint64_t, 3> parts{version.identity, version.contents, version.file};
  return checksum(parts.data(), sizeof parts);
}

bool has_box(const ObjectVersion& version) {
  return version.box[0] <= version.box[2] && version.box[1] <= version.box[3];
}

// Returns whether the boxes have half of the smaller one in common: levels of detail of one object
// do, and objects of one id in different places do not.
bool lie_together(const ObjectVersion& a, const ObjectVersion& b) {
  if (!has_box(a) || !has_box(b)) return false;
  constexpr double thin_m = 0.01;  // added to sides: a wall that runs north has no width
  const auto side = [](double low, double high) { return high - low + thin_m; };
  double common = 1, of_a = 1, of_b = 1;
  for (const std::size_t i : {0u, 1u}) {
    const double low = std::max(a.box[i], b.box[i]), high = std::min(a.box[i + 2], b.box[i + 2]);
    if (low > high) return false;
    common *= side(low, high);
    of_a *= side(a.box[i], a.box[i + 2]);
    of_b *= side(b.box[i], b.box[i + 2]);
  }
  return 2 * common >= std::min(of_a, of_b);
}

bool differ_in_lod(const ObjectVersion& a, const ObjectVersion& b) {
  return a.lod >= 0 && b.lod >= 0 && a.lod != b.lod;
}

}  // namespace

// In one file two objects may have one id and a corner in common, and still be two, unless they
// are of different levels of detail.
const ObjectVersion* ObjectVersions::find_same(const ObjectVersion& version) const {
  const auto is_same = [&](const ObjectVersion& other) {
    const bool is_place = other.identity == version.identity || lie_together(other, version);
    if (!is_place || other.type != version.type) return false;
    return other.file != version.file || other.contents == version.contents ||
           differ_in_lod(other, version);
  };
  if (const auto at = kept_.find(version.identity); at != kept_.end() && is_same(at->second))
    return &at->second;
  const auto [first, last] = identities_.equal_range(version.id);
  for (auto at = first; at != last; ++at)
    if (const auto other = kept_.find(at->second); other != kept_.end() && is_same(other->second))
      return &other->second;
  return nullptr;
}

void ObjectVersions::keep(const ObjectVersion& version) {
  if (!kept_.try_emplace(version.identity, version).second || !has_box(version)) return;
  if (identities_.count(version.id) < max_places) identities_.emplace(version.id, version.identity);
}

void ObjectVersions::forget(ObjectVersion version) {
  kept_.erase(version.identity);
  const auto [first, last] = identities_.equal_range(version.id);
  const auto at =
      std::find_if(first, last, [&](const auto& one) { return one.second == version.identity; });
  if (at != last) identities_.erase(at);
}

// The files that hold the parts may come before that of the whole, or behind it.
void ObjectVersions::join(const ObjectVersion& whole, const std::vector<std::string>& ids) {
  for (const std::string& text : ids) {
    const std::uint64_t id = checksum(text.data(), text.size());
    joined_.try_emplace(id, whole);
    std::vector<ObjectVersion> parts;
    const auto [first, last] = identities_.equal_range(id);
    for (auto at = first; at != last; ++at)
      if (const auto part = kept_.find(at->second);
          part != kept_.end() && lie_together(part->second, whole))
        parts.push_back(part->second);
    for (const ObjectVersion& part : parts) {
      outdated_.emplace(make_key(part), part_of_other);
      forget(part);
    }
  }
}

const char* ObjectVersions::take(const ObjectVersion& version,
                                 const std::vector<std::string>& joined) {
  if (version.identity == 0) return nullptr;
  if (const auto whole = joined_.find(version.id);
      whole != joined_.end() && lie_together(whole->second, version))
    return part_of_other;
  if (known_)
    if (const auto found = known_->reasons.find(make_key(version)); found != known_->reasons.end())
      return found->second;
  const ObjectVersion* same = find_same(version);
  if (!same) {
    join(version, joined);
    keep(version);
    return nullptr;
  }
  if (!differ_in_lod(*same, version))
    return same->file != version.file ? "in two files" : "twice in one file";
  if (city::is_better_level(same->lod, version.lod, max_lod_) ||
      (known_ && known_->rounds >= max_rounds))
    return worse;
  outdated_.emplace(make_key(*same), worse);
  forget(*same);
  keep(version);
  return nullptr;
}

void ObjectVersions::finish() const {
  if (outdated_.empty()) return;
  const auto all = std::make_shared<OutdatedVersions>();
  if (known_) *all = *known_;
  all->reasons.insert(outdated_.begin(), outdated_.end());
  ++all->rounds;
  throw BetterLevelsFollow(all);
}

}  // namespace nightcity::bake
