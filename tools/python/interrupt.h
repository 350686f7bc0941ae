// Work that leaves Python's other threads running and ends with Ctrl-C.
#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace warmjoint::python {

/// Fits that were interrupted and have not noticed it yet: the interpreter must not end before they do.
inline std::vector<std::thread> abandoned_threads;

/// Why a fit that nobody waits for ends.
struct Interrupted {};

/// Calls work(stop) in a thread of its own, without the interpreter's lock, and raises what Python's signal handlers raise
/// meanwhile (Ctrl-C), or watch(), which is called fifty times a second with the lock. stop() throws once nobody waits; work must own what
/// it uses.
template <class Work, class Watch>
auto Interruptibly(Work work, const Watch& watch) {
  const auto abandoned = std::make_shared<std::atomic<bool>>(false);
  const auto stop = [abandoned] {
    if (*abandoned) throw Interrupted{};
  };
  std::packaged_task<decltype(work(stop))()> task(
      [work = std::move(work), stop] { return work(stop); });
  auto answer = task.get_future();
  std::thread thread(std::move(task));
  {
    nanobind::gil_scoped_release released;
    while (answer.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
      nanobind::gil_scoped_acquire held;
      try {
        if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
        watch();
      } catch (...) {
        *abandoned = true;
        abandoned_threads.push_back(std::move(thread));
        throw;
      }
    }
  }
  thread.join();
  return answer.get();
}

template <class Work>
auto Interruptibly(Work work) {
  return Interruptibly(std::move(work), [] {});
}

/// Lets the interpreter's end wait for what was abandoned.
inline void WaitAtExit() {
  nanobind::module_::import_("atexit").attr("register")(nanobind::cpp_function([] {
    nanobind::gil_scoped_release released;
    for (std::thread& thread : abandoned_threads) thread.join();
    abandoned_threads.clear();
  }));
}

}  // namespace warmjoint::python
