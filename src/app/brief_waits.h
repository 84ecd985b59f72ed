#pragma once
/// How long a thread that has done its share spins before it sleeps.

namespace sluice {

/// Starts the program again with GOMP_SPINCOUNT = 1000, unless the caller has set it or OMP_WAIT_POLICY.
///
/// GCC's OpenMP spins 300 000 times at the end of each loop, and reads the number before main. On a machine
/// that others use, threads then wait for threads that do not run: a run on two of two busy cores took 23.6 s
/// where one thread took 6.0 s; with 1000 it takes 5.6 s, and on a quiet machine the same as before. Returns
/// where nothing is to be done or the program cannot be started again.
void wait_briefly(char** argv);

}  // namespace sluice
