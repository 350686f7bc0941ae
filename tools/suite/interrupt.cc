#include "tools/suite/interrupt.h"

#include <atomic>
#include <csignal>

namespace warmjoint {
namespace {

std::atomic<bool> interrupted = false;  // lock-free, so that a handler may set it

extern "C" void OnInterrupt(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void CatchInterrupts() {
  interrupted = false;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, OnInterrupt);
}

bool Interrupted() { return interrupted; }

}  // namespace warmjoint
