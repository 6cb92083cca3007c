#ifndef OBSCURA_TESTS_ALLOCATION_FAILING_ALLOCATIONS_H_
#define OBSCURA_TESTS_ALLOCATION_FAILING_ALLOCATIONS_H_

namespace obscura::allocation {

// Makes the n-th allocation of this program from now on (from 0) fail with std::bad_alloc, once.
void fail_at(long n);

// Lifts it; returns whether it was reached.
bool stop_failing();

}  // namespace obscura::allocation

#endif  // OBSCURA_TESTS_ALLOCATION_FAILING_ALLOCATIONS_H_
