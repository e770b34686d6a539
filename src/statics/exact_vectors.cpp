#include "statics/exact_vectors.h"

#include <petsc/private/vecimpl.h>

#include <cmath>

#include "base/exact_sum.h"

namespace koshi::statics {
namespace {

Communicator communicator_of(Vec vector) {
  MPI_Comm comm = MPI_COMM_NULL;
  PetscObjectGetComm(reinterpret_cast<PetscObject>(vector), &comm);
  return Communicator::from_handle(MPI_Comm_c2f(comm));
}

PetscErrorCode exact_dot(Vec x, Vec y, PetscScalar* result) {
  const PetscScalar *a = nullptr, *b = nullptr;
  PetscInt count = 0;
  PetscCall(VecGetLocalSize(x, &count));
  PetscCall(VecGetArrayRead(x, &a));
  PetscCall(VecGetArrayRead(y, &b));
  ExactSum sum;
  for (PetscInt i = 0; i < count; ++i) sum += a[i] * b[i];
  PetscCall(VecRestoreArrayRead(y, &b));
  PetscCall(VecRestoreArrayRead(x, &a));
  sum.sum_ranks(communicator_of(x));
  *result = sum.value();
  return 0;
}

PetscErrorCode exact_norm(Vec x, NormType type, PetscReal* result) {
  if (type != NORM_2) return PETSC_ERR_SUP;
  PetscScalar square = 0;
  PetscCall(exact_dot(x, x, &square));
  *result = std::sqrt(square);
  return 0;
}

// y += alpha x. Libraries of linear algebra may fuse the product and the sum of some elements and not of others.
PetscErrorCode plain_axpy(Vec y, PetscScalar alpha, Vec x) {
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  PetscInt count = 0;
  PetscCall(VecGetLocalSize(x, &count));
  PetscCall(VecGetArrayRead(x, &from));
  PetscCall(VecGetArray(y, &to));
  for (PetscInt i = 0; i < count; ++i) to[i] += alpha * from[i];
  PetscCall(VecRestoreArray(y, &to));
  return VecRestoreArrayRead(x, &from);
}

}  // namespace

void use_exact_sums(Vec vector) {
  vector->ops->dot = exact_dot;
  vector->ops->tdot = exact_dot;
  vector->ops->norm = exact_norm;
  vector->ops->axpy = plain_axpy;
}

}  // namespace koshi::statics
