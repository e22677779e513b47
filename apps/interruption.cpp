#include "apps/interruption.hpp"

#include <csignal>
#include <ctime>

namespace radiosity {
namespace {

// A signal handler can reach nothing but what is global.
volatile std::sig_atomic_t pending_signal = 0;
volatile std::time_t pending_since = 0;

// Who asks again after seconds of waiting means it: some steps, such as a factorization, cannot be
// interrupted in order.
extern "C" void remember_signal(int signal) {
  constexpr std::time_t patience = 2;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (pending_signal != 0 && now.tv_sec - pending_since >= patience) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  if (pending_signal == 0) pending_since = now.tv_sec;
  pending_signal = signal;
}

}  // namespace

void watch_for_interruption() {
  struct sigaction action {};
  action.sa_handler = remember_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int received_signal() {
  return pending_signal;
}

}  // namespace radiosity
