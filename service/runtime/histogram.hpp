#pragma once
// Distribution of times in fixed memory: 32 buckets an octave (the idea of HdrHistogram, Tene
// 2012), so a quantile is known to 3 %. One thread records, any thread reads.

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "service/runtime/records.hpp"

namespace adstar::runtime {

class Histogram {
 public:
  /// Negative times count as zero.
  void record(std::int64_t ns) noexcept {
    const auto value = static_cast<std::uint64_t>(ns < 0 ? 0 : ns);
    increment(buckets_[bucket_of(value)]);
    increment(count_);
    sum_.store(sum_.load(std::memory_order_relaxed) + value, std::memory_order_relaxed);
    if (value > maximum_.load(std::memory_order_relaxed)) {
      maximum_.store(value, std::memory_order_relaxed);
    }
  }

  std::uint64_t sum_ns() const noexcept { return sum_.load(std::memory_order_relaxed); }

  QuarterOctaveCounts quarter_octaves() const noexcept {
    // Every edge is one of buckets, too.
    QuarterOctaveCounts counts{};
    std::size_t i = 0;
    for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
      while (i + 1 < kQuarterOctaves &&
             top_of(bucket) >= static_cast<std::uint64_t>(quarter_octave_edge_ns(i))) {
        ++i;
      }
      counts[i] += buckets_[bucket].load(std::memory_order_relaxed);
    }
    return counts;
  }

  QuantilesRecord quantiles() const noexcept {
    QuantilesRecord result;
    result.count = count_.load(std::memory_order_relaxed);
    result.max_ns = static_cast<std::int64_t>(maximum_.load(std::memory_order_relaxed));
    result.p50_ns = result.p99_ns = result.p99_9_ns = result.max_ns;
    // In one pass, so that what is recorded meanwhile brings none of them past another.
    const std::array<std::pair<double, std::int64_t*>, 3> wanted{
        {{0.5, &result.p50_ns}, {0.99, &result.p99_ns}, {0.999, &result.p99_9_ns}}};
    auto next = wanted.begin();
    std::uint64_t seen = 0;
    for (std::size_t bucket = 0; bucket < kBuckets && next != wanted.end(); ++bucket) {
      seen += buckets_[bucket].load(std::memory_order_relaxed);
      while (next != wanted.end() && seen > 0 &&
             static_cast<double>(seen) >= next->first * static_cast<double>(result.count)) {
        *next->second = std::min(static_cast<std::int64_t>(top_of(bucket)), result.max_ns);
        ++next;
      }
    }
    return result;
  }

 private:
  static constexpr std::size_t kPerOctave = 32;
  static constexpr std::size_t kBuckets = kPerOctave * 60;

  static void increment(std::atomic<std::uint64_t>& counter) noexcept {
    // One writer: a load and a store, no locked instruction.
    counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  static std::size_t bucket_of(std::uint64_t value) noexcept {
    if (value < kPerOctave) {
      return static_cast<std::size_t>(value);
    }
    const auto octave = static_cast<std::size_t>(std::bit_width(value)) - 6;  // 0 for 32 to 63
    return kPerOctave * (octave + 1) +
           static_cast<std::size_t>((value >> octave) & (kPerOctave - 1));
  }

  /// The largest value that falls into a bucket.
  static std::uint64_t top_of(std::size_t bucket) noexcept {
    if (bucket < kPerOctave) {
      return bucket;
    }
    const std::size_t octave = bucket / kPerOctave - 1;
    const std::uint64_t first = (kPerOctave + bucket % kPerOctave) << octave;
    return first + ((std::uint64_t{1} << octave) - 1);
  }

  std::atomic<std::uint64_t> buckets_[kBuckets]{};
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::uint64_t> sum_{0};
  std::atomic<std::uint64_t> maximum_{0};
};

}  // namespace adstar::runtime
