// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace swiftlet {

/// The random numbers of one source of noise. Every source has its own generator, derived from the run's seed
/// and the source's name, so that a new source, or more numbers drawn from one, does not change the others.
class NoiseSource {
 public:
  NoiseSource(std::uint64_t seed, std::string_view name) : generator_(mixed(seed ^ hashed(name))) {}

  [[nodiscard]] double uniform(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(generator_);
  }
  [[nodiscard]] double gaussian(double sigma) { return sigma * normal_(generator_); }
  [[nodiscard]] bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  /// `magnitude` or its negative, with equal probability.
  [[nodiscard]] double either_sign(double magnitude) { return chance(0.5) ? magnitude : -magnitude; }

 private:
  /// FNV-1a.
  static constexpr std::uint64_t hashed(std::string_view name) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return hash;
  }
  /// The finalizer of SplitMix64: neighbouring seeds give unrelated generators.
  static constexpr std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
  }

  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

}  // namespace swiftlet
