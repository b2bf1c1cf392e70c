#include "tools/bake/parts/bake_part.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "formats/checksum.h"
#include "formats/error.h"
#include "tools/archive.h"
#include "tools/bake/city/building_uses.h"
#include "tools/bake/city/city.h"
#include "tools/bake/city/prepared_objects.h"
#include "tools/bake/parts/fingerprint.h"
#include "tools/bake/parts/packed_objects.h"
#include "tools/bake/parts/part_file.h"
#include "tools/bake/stages/window_stage.h"

namespace nightcity::bake {
namespace {

namespace fs = std::filesystem;

// Returns the survey that an earlier part has left; nothing where there is none of these inputs.
std::shared_ptr<const CitySurvey> load_survey(const fs::path& path,
                                              const std::string& fingerprint) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto survey = std::make_shared<CitySurvey>();
  try {
    Unpacker unpack(bytes, path.string());
    std::string found, packed;
    std::uint64_t sum = 0;
    unpack(found, packed, sum);
    if (found != fingerprint || sum != checksum(packed.data(), packed.size())) return {};
    Unpacker{packed, path.string()}(*survey);
  } catch (const Error&) {
    return {};
  }
  return survey;
}

// Holds a lock on a folder, where its file system has locks, until it is destroyed.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder)
      : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ >= 0) ::flock(descriptor_, LOCK_EX);
  }
  ~FolderLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

std::shared_ptr<const CitySurvey> find_survey(const CityInputs& inputs, const fs::path& path,
                                              const std::string& fingerprint) {
  // Parts that begin together wait for the first of them, and do not all make the same survey.
  const FolderLock lock(path.parent_path());
  if (auto survey = load_survey(path, fingerprint)) return survey;
  auto survey = std::make_shared<const CitySurvey>(survey_city(inputs));
  std::string packed, bytes;
  Packer{packed}(*survey);
  Packer{bytes}(fingerprint, packed, checksum(packed.data(), packed.size()));
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
  return survey;
}

class PartBake {
 public:
  PartBake(const BakeOptions& options, PartWriter& writer, const fs::path& scratch,
           const ProgressSink& progress)
      : writer_(writer),
        progress_(progress),
        city_(options.city, scratch),
        use_at_(make_use_finder(city_)) {
    if (options.windows.lit) windows_.emplace(use_at_, options.windows, scratch);
    read_options_ = to_read_options(city_.inputs());
  }

  void read(const SharePiece& piece) {
    names_other_crs_ = false;
    const PieceHead head{piece.file, !piece.piece};
    write(BlockKind::piece, head);
    city::ReadReport report;
    read_options_.piece = piece.piece;
    try {
      report = read_ready_objects(
          city_.inputs(), to_ready_settings(city_.inputs(), city_.frames(), city_.ground_heights()),
          piece.file, read_options_,
          [&](std::vector<ReadyObject>&& objects) { return pack(std::move(objects), piece.file); });
    } catch (const Error& error) {
      // A piece ends inside a comment where the file was cut there. The merge reads such a file
      // whole, and says what is wrong with it if it was not the cut.
      if (!piece.piece || writer_.has_failed()) throw;
      report.needs_whole_file = error.what();
    }
    if (names_other_crs_) report.needs_whole_file = "its geometries name several CRSs";
    if (!report.needs_whole_file.empty())
      fmt::print(stderr, "note: {}: the merge will read this file whole: {}\n",
                 city_.inputs().files[piece.file].string(), report.needs_whole_file);
    write(BlockKind::report, report);
  }

  std::uint64_t objects() const { return objects_; }

 private:
  template <class T>
  void write(BlockKind kind, const T& value) {
    std::string bytes;
    Packer{bytes}(value);
    writer_.write(kind, bytes);
  }

  std::function<void()> pack(std::vector<ReadyObject>&& objects, std::size_t file) {
    // Such names are learnt in the order of all files, which a part does not know.
    if (std::any_of(objects.begin(), objects.end(),
                    [](const ReadyObject& ready) { return ready.unknown.has_value(); })) {
      names_other_crs_ = true;
      return {};
    }
    for (ReadyObject& ready : objects)
      if (ready.unusable == Unusable::no && !ready.prepared->mesh.triangles.empty())
        find_use_and_windows(*ready.prepared);
    const std::uint64_t count = objects.size();
    const auto bytes = std::make_shared<const std::string>(pack_objects(objects));
    return [this, bytes, count, file] {
      writer_.write(BlockKind::objects, *bytes);
      objects_ += count;
      if (progress_) progress_({describe_reading(city_.inputs(), file), objects_, "objects"});
    };
  }

  // Both need outlines, which the part does not keep.
  void find_use_and_windows(PreparedObject& prepared) const {
    if (prepared.object.type == city::ObjectType::building)
      prepared.use = lights::use_of(prepared.object, use_at_).use;
    if (windows_)
      prepared.windows = std::make_shared<const lights::WindowLayout::WindowBatch>(
          windows_->find_windows(prepared.object));
  }

  PartWriter& writer_;
  const ProgressSink& progress_;
  City city_;
  lights::UseAt use_at_;
  std::optional<WindowConsumer> windows_;
  city::ReadOptions read_options_;
  std::uint64_t objects_ = 0;
  std::atomic<bool> names_other_crs_ = false;
};

}  // namespace

std::string name_part(const Share& share) {
  return fmt::format("part-{}-of-{}", share.number, share.count);
}

BakedPart bake_part(const BakeOptions& given, const Share& share, const fs::path& folder,
                    const std::string& version, const ProgressSink& progress) {
  BakeOptions options = given;
  const fs::path parts = folder / parts_folder;
  BakedPart part{parts / name_part(share)};
  const PartHead head{make_fingerprint(options.city, version),
                      fs::absolute(options.city.recipe).lexically_normal().string(), share};
  if (const auto there = read_part_head(part.file);
      there && there->fingerprint == head.fingerprint && there->share == share) {
    part.was_done = true;
    return part;
  }
  std::error_code error;
  fs::create_directories(parts, error);
  if (error) throw Error(parts.string(), "cannot be made: " + error.message());
  options.city.survey = find_survey(options.city, parts / "survey", head.fingerprint);
  PartWriter writer(part.file, head);
  PartBake bake(options, writer, part.file, progress);
  for (const SharePiece& piece : find_pieces(options.city, *options.city.survey, share))
    bake.read(piece);
  writer.commit();
  part.objects = bake.objects();
  part.bytes = writer.size();
  return part;
}

}  // namespace nightcity::bake
