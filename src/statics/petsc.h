// PETSc objects with owners, and its error codes as errors.
#pragma once

#include <petscksp.h>

#include <string>
#include <utility>
#include <vector>

#include "koshi/communicator.h"

namespace koshi::statics {

/// Throws RunError, in words of ours, when the code is not success; std::bad_alloc when memory ran out.
void check(PetscErrorCode code);

/// Owns one PETSc object.
template <class T, PetscErrorCode (*destroy)(T*)>
class Owner {
 public:
  Owner() = default;
  Owner(Owner&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Owner& operator=(Owner&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Owner() {
    if (object_ != nullptr) destroy(&object_);
  }
  operator T() const { return object_; }
  /// For PETSc's functions that create an object.
  T* create() { return &object_; }

 private:
  T object_ = nullptr;
};

using PetscVec = Owner<Vec, VecDestroy>;
using PetscMat = Owner<Mat, MatDestroy>;
using PetscKsp = Owner<KSP, KSPDestroy>;

/// PETSc for the life of the object, with its own set of options; all PETSc objects must be gone before it.
class PetscSession {
 public:
  /// `options` as on a command line: "-ksp_monitor", "-coarse_pc_type", "lu".
  PetscSession(const Communicator& communicator, const std::vector<std::string>& options);
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;

  /// Options that neither PETSc's start nor anything since has asked for.
  std::vector<std::string> unused_options() const;

 private:
  bool owns_ = false;
  std::vector<std::string> taken_at_start_;
  PetscOptions options_ = nullptr;
};

}  // namespace koshi::statics
