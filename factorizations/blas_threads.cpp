#include "factorizations/blas_threads.hpp"

#include <cblas.h>

namespace radiosity {

BlasThreads::BlasThreads(int count) : before_(openblas_get_num_threads()) {
  if (count != before_) openblas_set_num_threads(count);
}

BlasThreads::~BlasThreads() {
  if (current() != before_) openblas_set_num_threads(before_);
}

int BlasThreads::current() {
  return openblas_get_num_threads();
}

}  // namespace radiosity
