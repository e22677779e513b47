#include "apps/interruption.hpp"

#include <csignal>

namespace radiosity {
namespace {

// A signal handler can reach nothing but what is global.
volatile std::sig_atomic_t pending_signal = 0;

extern "C" void remember_signal(int signal) {
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
