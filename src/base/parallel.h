#pragma once
/// Loops over threads whose results do not depend on how many there are.
///
/// Work is cut into chunks of a fixed length, whatever the thread count; sums are taken chunk by
/// chunk and added in chunk order. Never an atomic on a float, never an OpenMP reduction.

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <vector>

namespace sluice {

inline int thread_count() {
  return omp_get_max_threads();
}
/// Of thread_count(), within a loop.
inline int this_thread() {
  return omp_get_thread_num();
}
inline void set_thread_count(int n) {
  omp_set_num_threads(n);
}

/// One chunk, by the same instructions wherever it is called from: were the body compiled into the loop of
/// one thread and into that of several, multiplications and additions could be fused differently in the two.
template <class Body>
[[gnu::noipa]] void run_chunk(const Body& body, std::size_t c, std::size_t begin, std::size_t end) {
  body(c, begin, end);
}

/// Which thread takes a chunk: whichever is free, or the same in every loop over as many chunks, which then
/// finds in its cache what it wrote before. In loops of microseconds that outweighs what it waits for others.
enum class ChunkGoes { to_free_thread, to_same_thread };

/// Calls body(chunk, begin, end) for each chunk of [0, n). An exception thrown by a chunk is thrown
/// again after the loop; of several, the one of the lowest chunk.
template <ChunkGoes goes = ChunkGoes::to_free_thread, class Body>
void parallel_chunks(std::size_t n, std::size_t chunk_length, const Body& body) {
  const std::size_t chunks = (n + chunk_length - 1) / chunk_length;
  if (chunks <= 1 || thread_count() == 1) {
    for (std::size_t c = 0; c < chunks; ++c)
      run_chunk(body, c, c * chunk_length, std::min(n, (c + 1) * chunk_length));
    return;
  }
  std::exception_ptr error;
  std::size_t error_chunk = chunks;
  const auto run = [&](std::size_t c) {
    try {
      run_chunk(body, c, c * chunk_length, std::min(n, (c + 1) * chunk_length));
    } catch (...) {
#pragma omp critical(sluice_parallel_error)
      if (c < error_chunk) {
        error = std::current_exception();
        error_chunk = c;
      }
    }
  };
  if constexpr (goes == ChunkGoes::to_same_thread) {
#pragma omp parallel for schedule(static)
    for (std::size_t c = 0; c < chunks; ++c) run(c);
  } else {
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t c = 0; c < chunks; ++c) run(c);
  }
  if (error) std::rethrow_exception(error);
}

/// Calls body(scratch, chunk, begin, end) for each chunk; `scratch` is the thread's own, one entry of `all` a
/// thread. What a body finds there is left over from other chunks: nothing may depend on it.
template <class Scratch, class Body>
void parallel_chunks_with(std::vector<Scratch>& all, std::size_t n, std::size_t chunk_length,
                          const Body& body) {
  all.resize(std::max(all.size(), static_cast<std::size_t>(thread_count())));
  parallel_chunks(n, chunk_length, [&](std::size_t c, std::size_t begin, std::size_t end) {
    body(all[static_cast<std::size_t>(this_thread())], c, begin, end);
  });
}

/// Calls body(i) for each i in [0, n).
template <class Body>
void parallel_for(std::size_t n, const Body& body, std::size_t chunk_length = 256) {
  parallel_chunks(n, chunk_length, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Sum of term(i) over [0, n): the same bits for any number of threads. T needs += and T{} as zero.
template <class T, class Term>
T parallel_sum(std::size_t n, const Term& term, T zero = T{}, std::size_t chunk_length = 1024) {
  std::vector<T> partial((n + chunk_length - 1) / chunk_length, zero);
  parallel_chunks(n, chunk_length, [&](std::size_t c, std::size_t begin, std::size_t end) {
    T sum = zero;
    for (std::size_t i = begin; i < end; ++i) sum += term(i);
    partial[c] = sum;
  });
  T total = zero;
  for (const T& p : partial) total += p;
  return total;
}

}  // namespace sluice
