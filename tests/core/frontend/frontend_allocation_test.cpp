// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Interposes malloc and its kin in this program alone: counting operator new misses what Eigen takes.
#include <gtest/gtest.h>

#include <cerrno>
#include <cstddef>

#include "core/frontend/frontend.hpp"
#include "tests/core/frontend/room_drive.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCounting = false;  // sanitizers bring a malloc of their own
#else
constexpr bool kCounting = true;
#endif

namespace {
thread_local bool watched = false;
thread_local std::size_t allocations = 0;

[[maybe_unused]] void count() {
  if (watched) ++allocations;
}
}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// NOLINTBEGIN(readability-identifier-naming,bugprone-reserved-identifier)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t items, std::size_t size) {
  count();
  return __libc_calloc(items, size);
}
void* realloc(void* old, std::size_t size) {
  count();
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  count();
  *out = __libc_memalign(alignment, size);
  return *out == nullptr ? ENOMEM : 0;
}
}
// NOLINTEND(readability-identifier-naming,bugprone-reserved-identifier)
#endif

namespace swiftlet {
namespace {

TEST(FrontendAllocation, InterposingSeesWhatEigenAllocates) {
  if (!kCounting) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  watched = true;
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(50, 50);
  watched = false;
  EXPECT_GT(allocations, 0U);
  EXPECT_EQ(matrix.rows(), 50);
}

TEST(FrontendAllocation, ProcessingAllocatesNothing) {
  if (!kCounting) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  FrontendConfig config;
  config.window_keyframes = 64;  // the largest system it can get
  config.association_keyframes = 64;
  const test::RoomDrive drive =
      test::drive_around(3, BeamLayout::multiranger(), SensorModel::crazyflie(), {1.0, 0.0}, 1);
  Frontend frontend(config, SensorModel::crazyflie(), BeamLayout::multiranger());
  allocations = 0;
  watched = true;
  for (const RangeSample& sample : drive.samples) frontend.process(sample);
  watched = false;
  EXPECT_EQ(allocations, 0U);
  EXPECT_GT(frontend.counters().poses_retired, 0U);
  EXPECT_GT(frontend.counters().observations_added, 100U);
}

}  // namespace
}  // namespace swiftlet
