// Random numbers that are the same on every platform. They come from integer hashes alone, because
// the standard library's distributions differ between implementations. Every street, house and
// window hashes its own place or name, so it comes out the same whichever part of a city is made,
// in whichever order.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace nightcity {

/// The amount that splitmix64 adds to its state for each number: 2^64 divided
/// by the golden ratio, odd.
constexpr std::uint64_t splitmix_increment = 0x9E3779B97F4A7C15ull;

/// One step of splitmix64 (Steele, Lea, Flood 2014): a bijection whose output bits all depend on
/// all input bits.
constexpr std::uint64_t mix(std::uint64_t x) {
  x += splitmix_increment;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

/// Returns the hash of a name, such as a gml:id: FNV-1a, mixed.
constexpr std::uint64_t hash_text(std::string_view text) {
  std::uint64_t hash = 0xCBF29CE484222325ull;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
  return mix(hash);
}

class Random {
 public:
  /// One stream per key, e.g. {seed, purpose, column, row}.
  Random(std::initializer_list<std::int64_t> key) {
    for (const std::int64_t part : key) state_ = mix(state_ ^ static_cast<std::uint64_t>(part));
  }

  std::uint64_t next() { return state_ = mix(state_); }
  /// [0, 1), never 1.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  double range(double low, double high) { return low + (high - low) * uniform(); }
  /// low..high, both included.
  int integer(int low, int high) {
    const auto span = static_cast<std::uint64_t>(high - low + 1);
    return low + static_cast<int>(((next() >> 32) * span) >> 32);
  }
  /// Mean 0, standard deviation 1, within +-6: the sum of twelve uniforms, which needs no
  /// logarithm.
  double normal() {
    double sum = -6;
    for (int n = 0; n < 12; ++n) sum += uniform();
    return sum;
  }
  bool chance(double probability) { return uniform() < probability; }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace nightcity
