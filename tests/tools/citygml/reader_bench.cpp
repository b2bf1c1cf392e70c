// Measures speed and memory of the CityGML readers on one file, each in a process of its own, so
// that it has its own peak.
//   reader_bench FILE... [--copies N] [--threads N] [--rounds N] [--markdown] [--stream-only]
// * --copies N feeds the file's members N times over as one document: a large city from a small
//   one.
// * --stream-only leaves libcitygml out, which takes long over a large file at 20 MB/s.
// * --markdown prints a row of the page of readers in docs/measurements for each file
//   (pipelines/readers_table.sh makes that page).
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "formats/error.h"
#include "tools/city/byte_source.h"
#include "tools/citygml/member_splitter.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::citygml {
namespace {

struct Measured {
  double seconds = 0;
  double cpu_seconds = 0;  // of all threads: a busy machine does not disturb it
  double peak_mb = 0;
  std::size_t objects = 0, polygons = 0, polygons_skipped = 0;
  char version[8] = {},
       skipped[200] = {};  // the most frequent names; plain arrays travel through a pipe
};

// "12 app:theme, 3 gen:value", the most frequent first.
std::string in_words(const city::ReadReport& report) {
  std::vector<std::pair<std::string, std::size_t>> sorted(report.skipped.begin(),
                                                          report.skipped.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  std::size_t shown = 0;
  for (const auto& [name, count] : sorted) {
    const std::string next = (text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
    if (text.size() + next.size() > 150) break;
    text += next;
    ++shown;
  }
  if (shown < sorted.size())
    text += " and " + std::to_string(sorted.size() - shown) + " more kinds";
  return text;
}

// Writes the file's members `copies` times between one root's tags. Ids repeat: readers keep
// members apart.
std::filesystem::path multiply(const std::filesystem::path& file, int copies) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("reader_bench_" + std::to_string(::getpid()) + ".gml");
  std::ofstream out(path, std::ios::binary);
  const std::vector<city::Document> documents = city::list_documents(file, citygml_endings);
  std::string root;
  for (int copy = 0; copy < copies; ++copy) {
    const auto source = documents.front().open();
    MemberSplitter splitter(*source, documents.front().name, {});
    if (copy == 0) out << splitter.head().root_tag << '\n';
    root = splitter.head().root_name;
    MemberBatch batch;
    while (splitter.next(batch))
      for (const MemberBatch::Member& member : batch.members)
        if (member.name != "boundedBy" || copy == 0) out << batch.text(member) << '\n';
  }
  out << "</" << root << ">\n";
  return path;
}

double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Measured measure_here(const std::filesystem::path& file, const city::ReadOptions& options,
                      int rounds) {
  Measured best;
  best.seconds = 1e30;
  best.cpu_seconds = 1e30;
  // A small file is read again until a fifth of a second has passed.
  double total = 0;
  for (int round = 0; round < rounds || (total < 0.2 && round < 200); ++round) {
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = cpu_seconds();
    const city::ReadReport report = read_citygml(file, options, [](city::CityObject&&) {});
    const double cpu = cpu_seconds() - cpu_start;
    best.cpu_seconds = std::min(best.cpu_seconds, cpu);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    total += cpu;
    best.seconds = std::min(best.seconds, seconds);
    best.objects = report.objects;
    best.polygons = report.polygons;
    best.polygons_skipped = 0;
    for (const auto& [what, count] : report.skipped)
      if (what.starts_with("polygon: ")) best.polygons_skipped += count;
    std::snprintf(best.version, sizeof best.version, "%s", report.version.c_str());
    std::snprintf(best.skipped, sizeof best.skipped, "%s", in_words(report).c_str());
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  best.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024;
  return best;
}

Measured measure(const std::filesystem::path& file, const city::ReadOptions& options, int rounds) {
  int channel[2];
  if (::pipe(channel) != 0) throw Error("", "cannot make a pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    bool sent = false;
    try {
      const Measured m = measure_here(file, options, rounds);
      sent = ::write(channel[1], &m, sizeof m) == sizeof m;
    } catch (const std::exception& error) {
      std::cerr << error.what() << '\n';
    }
    ::_exit(sent ? 0 : 1);
  }
  ::close(channel[1]);
  Measured m;
  const bool received = ::read(channel[0], &m, sizeof m) == sizeof m;
  ::close(channel[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!received || status != 0) throw Error(file.string(), "the reader failed");
  return m;
}

city::ReadOptions options_for(city::Reader reader, unsigned threads) {
  city::ReadOptions options;
  options.reader = reader;
  options.threads = threads;
  return options;
}

double megabytes_of(const std::filesystem::path& file) {
  return static_cast<double>(std::filesystem::file_size(file)) / 1e6;
}

// CPU time, not the clock: on one thread they are the same, and other work on the machine does not
// disturb it.
void print_row(const std::filesystem::path& file, int rounds) {
  try {
    const Measured other = measure(file, options_for(city::Reader::libcitygml, 1), rounds);
    const Measured one = measure(file, options_for(city::Reader::stream, 1), rounds);
    const std::string name =
        file.parent_path().filename().string() + "/" + file.filename().string();
    std::printf(
        "| %s | %.2f | %s | %zu | %zu | %zu | %.1f | %.1f | %.1f | %.0f | %.0f | %zu | %s |\n",
        name.c_str(), megabytes_of(file), one.version, one.objects, one.polygons,
        one.polygons_skipped, 1e3 * one.cpu_seconds, megabytes_of(file) / one.cpu_seconds,
        other.cpu_seconds / one.cpu_seconds, one.peak_mb, other.peak_mb, other.polygons,
        one.skipped);
  } catch (const std::exception& error) {
    std::printf("| %s | %.2f | | | | | | | | | | | refused: %s |\n", file.filename().c_str(),
                megabytes_of(file), error.what());
  }
  std::fflush(stdout);
}

void print_table(const std::filesystem::path& file, unsigned threads, int rounds,
                 bool stream_only) {
  const double megabytes = megabytes_of(file);
  std::printf("%s: %.1f MB\n%-22s %9s %9s %9s %9s %10s %10s\n", file.c_str(), megabytes, "reader",
              "s", "CPU s", "MB/s", "peak MB", "objects", "polygons");
  const auto line = [&](const char* name, city::Reader reader, unsigned n) {
    const Measured m = measure(file, options_for(reader, n), rounds);
    std::printf("%-22s %9.3f %9.3f %9.1f %9.1f %10zu %10zu\n", name, m.seconds, m.cpu_seconds,
                megabytes / m.seconds, m.peak_mb, m.objects, m.polygons);
    std::fflush(stdout);
    return m;
  };
  std::optional<Measured> second_opinion;
  if (!stream_only) second_opinion = line("libcitygml", city::Reader::libcitygml, 1);
  const Measured one = line("stream, one thread", city::Reader::stream, 1);
  const Measured all = line("stream, all threads", city::Reader::stream, threads);
  if (second_opinion)
    std::printf("stream / libcitygml on one core: %.2f times as fast (CPU time: %.2f); ",
                second_opinion->seconds / one.seconds,
                second_opinion->cpu_seconds / one.cpu_seconds);
  std::printf("all threads / one thread: %.2f\n", one.seconds / all.seconds);
}

int run(int argc, char** argv) {
  std::vector<std::filesystem::path> files;
  int copies = 1, rounds = 3;
  unsigned threads = 0;
  bool markdown = false, stream_only = false;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (i + 1 < argc && option == "--copies")
      copies = std::atoi(argv[++i]);
    else if (i + 1 < argc && option == "--threads")
      threads = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (i + 1 < argc && option == "--rounds")
      rounds = std::atoi(argv[++i]);
    else if (option == "--stream-only")
      stream_only = true;
    else if (option == "--markdown")
      markdown = true;
    else
      files.emplace_back(option);
  }
  if (files.empty() || copies < 1 || rounds < 1) {
    std::cerr << "usage: reader_bench FILE... [--copies N] [--threads N] [--rounds N] [--markdown] "
                 "[--stream-only]\n";
    return 2;
  }
  for (const std::filesystem::path& file : files) {
    if (markdown) {
      print_row(file, rounds);
    } else if (copies == 1) {
      print_table(file, threads, rounds, stream_only);
    } else {
      const std::filesystem::path large = multiply(file, copies);
      print_table(large, threads, rounds, stream_only);
      std::filesystem::remove(large);
    }
  }
  return 0;
}

}  // namespace
}  // namespace nightcity::citygml

int main(int argc, char** argv) {
  try {
    return nightcity::citygml::run(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
