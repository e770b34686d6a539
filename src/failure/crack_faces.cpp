#include "failure/crack_faces.h"

namespace koshi::failure {
namespace {

// Strain of the crack's plane: opening, and shear along it.
struct FaceStrain {
  double opening;
  Vec3 shear;
};

FaceStrain face_strain(const Vec3& n, const Tensor6& strain) {
  const Vec3 pull = times(strain, n);
  const double opening = dot(pull, n);
  return {opening, 2 * (pull - opening * n)};
}

}  // namespace

Vec3 slide(const FaceModuli& moduli, double friction, const Vec3& n, const Vec3& slip, const Tensor6& strain) {
  const FaceStrain face = face_strain(n, strain);
  // Open faces lie where they are: the shear so far will leave no stress behind.
  if (face.opening >= 0) return face.shear;
  const Vec3 stuck = face.shear - slip;
  const double size = norm(stuck), allowed = -friction * moduli.youngs_modulus * face.opening / moduli.mu;
  return size <= allowed ? slip : face.shear - (allowed / size) * stuck;
}

FaceContact face_contact(const FaceModuli& moduli, const Vec3& n, const Vec3& slip, const Tensor6& strain) {
  FaceContact contact;
  const FaceStrain face = face_strain(n, strain);
  if (face.opening >= 0) return contact;
  const double normal = moduli.youngs_modulus * face.opening;
  const Vec3 elastic = face.shear - slip;
  contact.shear = moduli.mu * elastic;
  contact.energy = 0.5 * (normal * face.opening + dot(contact.shear, elastic));
  // t = (normal stress) n + shear acts on the plane: n x n times the first, and n x shear made symmetric.
  for (std::size_t v = 0; v < 6; ++v) {
    const auto [i, j] = tensor_axes[v];
    contact.stress[v] = normal * n[i] * n[j] + contact.shear[i] * n[j] + contact.shear[j] * n[i];
  }
  return contact;
}

}  // namespace koshi::failure
