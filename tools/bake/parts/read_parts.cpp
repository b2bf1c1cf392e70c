#include "tools/bake/parts/read_parts.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "formats/error.h"
#include "tools/archive.h"
#include "tools/bake/city/prepared_objects.h"
#include "tools/bake/parts/packed_objects.h"
#include "tools/in_order.h"

namespace nightcity::bake {
namespace {

namespace fs = std::filesystem;

template <class T>
T unpack(const PartReader::Block& block, const PartReader& part) {
  T value;
  Unpacker{block.bytes, part.name()}(value);
  return value;
}

// Part files by name, in order: folders are searched.
std::vector<fs::path> list_parts(const std::vector<fs::path>& named) {
  std::vector<fs::path> files;
  for (const fs::path& path : named) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      PartReader{path};  // says what is wrong with it
      files.push_back(path);
      continue;
    }
    for (const fs::path& folder : {path, path / "parts"})
      for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
           entry.increment(error))
        if (entry->path().filename().string().starts_with("part-")) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  if (files.empty())
    throw Error(named.empty() ? std::string() : named.front().string(),
                "no part of a bake: make parts with nightbake run RECIPE --part 1/N --out DIR");
  return files;
}

// Returns "2, 5 and 7 more": numbers of parts.
std::string list_numbers(const std::vector<std::uint32_t>& numbers) {
  constexpr std::size_t shown = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, numbers.size()); ++i)
    text += (i ? ", " : "") + std::to_string(numbers[i]);
  if (numbers.size() > shown) text += " and " + std::to_string(numbers.size() - shown) + " more";
  return text;
}

class PartMerger {
 public:
  PartMerger(const CityInputs& inputs, CityFrames& frames, const GroundHeights* heights,
             std::span<CityConsumer* const> consumers, const ProgressSink& progress)
      : inputs_(inputs),
        options_(to_read_options(inputs)),
        feed_(inputs, frames, heights, consumers, progress) {}

  void find_whole_files(PartReader& part) {
    PieceHead piece;
    for (auto block = part.next(true); block.kind != BlockKind::end; block = part.next(true)) {
      if (block.kind == BlockKind::piece) piece = unpack<PieceHead>(block, part);
      if (block.kind == BlockKind::report &&
          !unpack<city::ReadReport>(block, part).needs_whole_file.empty())
        whole_files_.insert(piece.file);
    }
    part.rewind();
  }

  void read(PartReader& part) {
    for (auto block = part.next(); block.kind != BlockKind::end; block = part.next()) {
      if (block.kind != BlockKind::piece) throw Error(part.name(), "is damaged: no piece begins");
      const auto piece = unpack<PieceHead>(block, part);
      if (piece.file >= inputs_.files.size())
        throw Error(part.name(), "is damaged: it names a file that the city does not have");
      if (file_ != piece.file) {
        end_file();
        file_ = piece.file;
        is_read_whole_ = whole_files_.contains(piece.file);
        if (is_read_whole_)
          read_into(feed_, inputs_, piece.file, options_);
        else
          feed_.begin_file(piece.file);
      }
      read_piece(part, piece, is_read_whole_);
    }
  }

  CityReport finish() {
    end_file();
    return feed_.finish();
  }

 private:
  // Blocks of objects up to the report that ends the piece.
  void read_piece(PartReader& part, const PieceHead& piece, bool pass_over) {
    PartReader::Block last;
    const auto next = [&]() -> std::optional<PartReader::Block> {
      last = part.next(pass_over);
      if (last.kind != BlockKind::objects) return std::nullopt;
      return std::move(last);
    };
    in_order(
        options_.threads, next,
        [&](const PartReader::Block& block) {
          return feed_.prepare(unpack_objects(block.bytes, part.name()));
        },
        [&](ObjectFeed::Batch&& batch) { feed_.take(std::move(batch)); });
    if (last.kind != BlockKind::report) throw Error(part.name(), "is damaged: a piece has no end");
    if (pass_over) return;
    report_.merge(unpack<city::ReadReport>(last, part));
    is_in_pieces_ = !piece.is_whole_file;
  }

  // The report of a file that was read in pieces is finished here, else by its reader.
  void end_file() {
    if (!file_ || is_read_whole_) return;
    if (is_in_pieces_) city::finish_report(inputs_.files[*file_], report_);
    feed_.end_file(report_);
    report_ = {};
    is_in_pieces_ = false;
  }

  const CityInputs& inputs_;
  city::ReadOptions options_;
  ObjectFeed feed_;
  std::set<std::size_t> whole_files_;
  std::optional<std::size_t> file_;
  city::ReadReport report_;  // of the file
  bool is_in_pieces_ = false, is_read_whole_ = false;
};

}  // namespace

std::vector<fs::path> find_part_set(const std::vector<fs::path>& named,
                                    const std::string& fingerprint) {
  std::map<std::uint32_t, std::map<std::uint32_t, fs::path>> sets;  // by count, then number
  std::map<std::uint32_t, std::set<std::uint32_t>> stale;
  for (const fs::path& file : list_parts(named)) {
    const auto head = read_part_head(file);
    if (!head) throw Error(file.string(), "is damaged or cut off: make this part again");
    const Share& share = head->share;
    if (head->fingerprint == fingerprint)
      sets[share.count].emplace(share.number, file);
    else
      stale[share.count].insert(share.number);
  }
  for (const auto& [count, files] : sets) {
    if (files.size() != count) continue;
    std::vector<fs::path> result;
    for (const auto& [number, file] : files) result.push_back(file);
    return result;
  }
  const std::uint32_t count = sets.empty() ? stale.begin()->first : sets.begin()->first;
  std::vector<std::uint32_t> missing, old;
  for (std::uint32_t number = 1; number <= count; ++number)
    if (!sets[count].contains(number))
      (stale[count].contains(number) ? old : missing).push_back(number);
  std::string text = "not all parts of " + std::to_string(count) + " are there:";
  if (!missing.empty()) text += " missing: " + list_numbers(missing) + ";";
  if (!old.empty())
    text +=
        " made from another recipe or from inputs that have changed since: " + list_numbers(old) +
        ";";
  throw Error(named.front().string(),
              text + " make them with nightbake run RECIPE --part i/" + std::to_string(count));
}

fs::path find_recipe(const std::vector<fs::path>& named) {
  std::string recipe;
  for (const fs::path& file : list_parts(named)) {
    const auto head = read_part_head(file);
    if (!head) throw Error(file.string(), "is damaged or cut off: make this part again");
    if (!recipe.empty() && head->recipe != recipe)
      throw Error(file.string(), "is a part of the bake of " + head->recipe +
                                     ", and others are of " + recipe +
                                     ": name the recipe with --recipe");
    recipe = head->recipe;
  }
  std::error_code ignored;
  if (!fs::exists(recipe, ignored))
    throw Error(recipe,
                "is not there, and is the recipe that the parts name: say where it lies "
                "with --recipe");
  return recipe;
}

CityReport read_parts(const std::vector<fs::path>& parts, const CityInputs& inputs,
                      CityFrames& frames, const GroundHeights* heights,
                      std::span<CityConsumer* const> consumers, const ProgressSink& progress) {
  PartMerger merger(inputs, frames, heights, consumers, progress);
  for (const fs::path& path : parts) {
    PartReader part(path);
    merger.find_whole_files(part);
  }
  for (const fs::path& path : parts) {
    PartReader part(path);
    merger.read(part);
  }
  return merger.finish();
}

}  // namespace nightcity::bake
