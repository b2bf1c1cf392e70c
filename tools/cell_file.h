// Records of many cells on disk, added in any order and read again cell by cell, so that the most
// numerous things of a city (triangles of surfaces, walls, windows) take no memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <type_traits>
#include <vector>

#include "formats/scratch_file.h"

namespace nightcity {

/// Memory: `max_pending` records, and some thirty bytes per key. `Key` is ordered by <.
template <class Key, class Record>
class CellFile {
  static_assert(std::is_trivially_copyable_v<Record>, "records are stored as their bytes");

 public:
  /// The scratch file lies beside `path`.
  explicit CellFile(const std::filesystem::path& path, std::size_t max_pending = 16'384)
      : file_(path), max_pending_(max_pending) {}

  void add(const Key& key, const Record& record) {
    pending_.push_back({key, record});
    if (pending_.size() >= max_pending_) flush();
  }

  /// Returns all records added under the key, in the order of adding. After keys(), many threads
  /// may call it until something is added.
  std::vector<Record> read(const Key& key) {
    flush();
    const auto cell = find(key);
    if (cell == cells_.end() || key < cell->key) return {};
    std::vector<Record> records(cell->count);
    std::size_t end = records.size();
    for (std::uint64_t next = cell->last_block; next != nowhere;) {
      Block block;
      file_.read(next, &block, sizeof block);
      end -= block.count;
      file_.read(next + sizeof block, records.data() + end, block.count * sizeof(Record));
      next = block.previous;
    }
    return records;
  }

  /// Returns all keys, in order.
  std::vector<Key> keys() {
    flush();
    std::vector<Key> result;
    for (const Cell& cell : cells_) result.push_back(cell.key);
    return result;
  }

 private:
  static constexpr std::uint64_t nowhere = ~std::uint64_t{0};

  struct Pending {
    Key key;
    Record record;
  };
  /// Stands before records of one cell and names the block before it.
  struct Block {
    std::uint64_t previous;
    std::uint64_t count;
  };
  struct Cell {
    Key key;
    std::uint32_t count;
    std::uint64_t last_block;
  };

  auto find(const Key& key) {
    return std::lower_bound(cells_.begin(), cells_.end(), key,
                            [](const Cell& cell, const Key& wanted) { return cell.key < wanted; });
  }

  /// Pending records of one key that came one after the other.
  struct Run {
    std::uint32_t begin, end;
  };
  // Most records follow one of their own cell, so that runs are far fewer than records.
  std::vector<Run> find_runs() const {
    std::vector<Run> runs;
    for (std::uint32_t i = 0; i < pending_.size(); ++i) {
      const bool continues = !runs.empty() && !(pending_[i].key < pending_[i - 1].key) &&
                             !(pending_[i - 1].key < pending_[i].key);
      if (continues)
        ++runs.back().end;
      else
        runs.push_back({i, i + 1});
    }
    return runs;
  }

  void flush() {
    if (pending_.empty()) return;
    std::vector<Run> runs = find_runs();
    std::stable_sort(runs.begin(), runs.end(), [&](const Run& a, const Run& b) {
      return pending_[a.begin].key < pending_[b.begin].key;
    });
    const auto known = static_cast<std::ptrdiff_t>(cells_.size());
    std::vector<Record> records;
    for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
      const Key& key = pending_[runs[begin].begin].key;
      records.clear();
      for (; end < runs.size() && !(key < pending_[runs[end].begin].key); ++end)
        for (std::uint32_t i = runs[end].begin; i < runs[end].end; ++i)
          records.push_back(pending_[i].record);
      // New cells go behind the known ones, which stay sorted for find().
      const auto cell =
          std::lower_bound(cells_.begin(), cells_.begin() + known, key,
                           [](const Cell& c, const Key& wanted) { return c.key < wanted; });
      const bool is_new = cell == cells_.begin() + known || key < cell->key;
      Cell& taken = is_new ? cells_.emplace_back(Cell{key, 0, nowhere}) : *cell;
      const Block block{taken.last_block, records.size()};
      taken.last_block = file_.size();
      taken.count += static_cast<std::uint32_t>(block.count);
      file_.write(&block, sizeof block);
      file_.write(records.data(), records.size() * sizeof(Record));
    }
    std::inplace_merge(cells_.begin(), cells_.begin() + known, cells_.end(),
                       [](const Cell& a, const Cell& b) { return a.key < b.key; });
    pending_.clear();
    file_.flush();
  }

  ScratchFile file_;
  std::size_t max_pending_;
  std::vector<Pending> pending_;
  std::vector<Cell> cells_;
};

}  // namespace nightcity
