#ifndef OBSCURA_EXECUTOR_H_
#define OBSCURA_EXECUTOR_H_

#include <memory>
#include <type_traits>

#include "obscura/export.h"

namespace obscura {

// A borrowed callable: valid only while the call that takes it runs.
template <class Signature>
class FunctionRef;
template <class R, class... Args>
class FunctionRef<R(Args...)> {
 public:
  template <class F>
  requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef>) FunctionRef(F&& f)
      : object_(const_cast<void*>(static_cast<const void*>(&f))),
        call_([](void* object, Args... args) -> R {
          return (*static_cast<std::remove_reference_t<F>*>(object))(args...);
        }) {}
  R operator()(Args... args) const { return call_(object_, args...); }

 private:
  void* object_;
  R (*call_)(void*, Args...);
};

// Runs loops on threads. Implement it to lend Obscura the host's own job system.
class OBSCURA_API Executor {
 public:
  virtual ~Executor() = default;

  // How many calls may run at the same time, at least 1.
  virtual int thread_count() const = 0;

  // Calls body(index, worker) once for each index in [0, count), in any order, and returns when
  // all have returned. `worker` is in [0, thread_count()) and no two calls that run at the same
  // time share one. The body does not throw.
  virtual void parallel_for(int count, FunctionRef<void(int index, int worker)> body) = 0;
};

// `threads` from 1, at most one per processor that this process may use; 0 takes them all.
OBSCURA_API std::unique_ptr<Executor> make_executor(int threads = 0);

}  // namespace obscura

#endif  // OBSCURA_EXECUTOR_H_
