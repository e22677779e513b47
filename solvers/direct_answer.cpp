#include "solvers/direct_answer.hpp"

#include "foundation/error.hpp"

namespace radiosity {

DirectAnswer::DirectAnswer(const LinearOperator& global) : global_(global) {
  if (!global.global())
    fail<UsageError>("{} does not map E to B and needs a solver, such as gmres.", global.describe());
}

void DirectAnswer::start(const Field& emission) {
  check_emission(global_.describe(), global_, emission);
  radiosity_.resize(emission.rows(), emission.cols());
  global_.apply(emission, radiosity_);
}

}  // namespace radiosity
