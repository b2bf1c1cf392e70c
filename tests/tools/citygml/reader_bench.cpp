// Speed and memory of the CityGML readers on one file, each in a process of its own, so that their peaks are
// their own.
//   reader_bench FILE [--copies N] [--threads N] [--rounds N]
// --copies N feeds the file's members N times over as one document: a large city out of a small one.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "formats/error.h"
#include "tools/citygml/byte_source.h"
#include "tools/citygml/city_model.h"
#include "tools/citygml/member_splitter.h"

namespace nightcity {
namespace {

struct Measured {
  double seconds = 0;
  double cpu_seconds = 0;  // of all threads: what a busy machine does not disturb
  double peak_mb = 0;
  std::size_t objects = 0, polygons = 0;
};

// Writes the file's members `copies` times between one root's tags. Ids repeat: readers keep members apart.
std::filesystem::path multiply(const std::filesystem::path& file, int copies) {
  const auto path =
      std::filesystem::temp_directory_path() / ("reader_bench_" + std::to_string(::getpid()) + ".gml");
  std::ofstream out(path, std::ios::binary);
  const std::vector<Document> documents = documents_in(file);
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
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Measured measure_here(const std::filesystem::path& file, const ReadOptions& options, int rounds) {
  Measured best;
  best.seconds = 1e30;
  best.cpu_seconds = 1e30;
  for (int round = 0; round < rounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = cpu_seconds();
    const ReadReport report = read_citygml(file, options, [](CityObject&&) {});
    best.cpu_seconds = std::min(best.cpu_seconds, cpu_seconds() - cpu_start);
    best.seconds = std::min(best.seconds,
                            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    best.objects = report.objects;
    best.polygons = report.polygons;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  best.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024;
  return best;
}

Measured measure(const std::filesystem::path& file, const ReadOptions& options, int rounds) {
  int channel[2];
  if (::pipe(channel) != 0) throw Error("", "cannot make a pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    const Measured m = measure_here(file, options, rounds);
    const bool sent = ::write(channel[1], &m, sizeof m) == sizeof m;
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

int run(int argc, char** argv) {
  std::filesystem::path file;
  int copies = 1, rounds = 3;
  unsigned threads = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (i + 1 < argc && option == "--copies")
      copies = std::atoi(argv[++i]);
    else if (i + 1 < argc && option == "--threads")
      threads = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (i + 1 < argc && option == "--rounds")
      rounds = std::atoi(argv[++i]);
    else
      file = option;
  }
  if (file.empty() || copies < 1 || rounds < 1) {
    std::cerr << "usage: reader_bench FILE [--copies N] [--threads N] [--rounds N]\n";
    return 2;
  }
  const bool temporary = copies > 1;
  if (temporary) file = multiply(file, copies);
  const double megabytes = static_cast<double>(std::filesystem::file_size(file)) / 1e6;
  std::printf("%s: %.1f MB\n%-22s %9s %9s %9s %10s %10s\n", file.c_str(), megabytes, "reader", "s", "MB/s",
              "peak MB", "objects", "polygons");
  const auto line = [&](const char* name, Reader reader, unsigned n) {
    ReadOptions options;
    options.reader = reader;
    options.threads = n;
    const Measured m = measure(file, options, rounds);
    std::printf("%-22s %9.3f %9.3f %9.1f %9.1f %10zu %10zu\n", name, m.seconds, m.cpu_seconds,
                megabytes / m.seconds, m.peak_mb, m.objects, m.polygons);
    std::fflush(stdout);
    return m;
  };
  const Measured second_opinion = line("libcitygml", Reader::libcitygml, 1);
  const Measured one = line("stream, one thread", Reader::stream, 1);
  const Measured all = line("stream, all threads", Reader::stream, threads);
  std::printf(
      "stream / libcitygml on one core: %.2f times as fast (CPU time: %.2f); all threads / one thread: "
      "%.2f\n",
      second_opinion.seconds / one.seconds, second_opinion.cpu_seconds / one.cpu_seconds,
      one.seconds / all.seconds);
  if (temporary) std::filesystem::remove(file);
  return 0;
}

}  // namespace
}  // namespace nightcity

int main(int argc, char** argv) {
  try {
    return nightcity::run(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
