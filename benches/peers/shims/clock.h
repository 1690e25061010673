// Seconds that a piece of work takes by the wall clock.
#pragma once
#include <chrono>

template <class Work>
double seconds_of(Work work) {
  using clock = std::chrono::steady_clock;
  const auto start = clock::now();
  work();
  return std::chrono::duration<double>(clock::now() - start).count();
}
