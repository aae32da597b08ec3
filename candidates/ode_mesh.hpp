#pragma once

#include <memory>
#include <ode/ode.h>
#include <utility>
#include <vector>

#include "candidates/floor.hpp"

namespace touchstone {

/// A mesh of triangles, counterclockwise seen from outside; ODE keeps pointers to all of it.
class OdeMesh {
 public:
  OdeMesh(std::vector<Vec3> corners, std::vector<dTriIndex> indices)
      : corners_(std::move(corners)),
        indices_(std::move(indices)),
        data_(dGeomTriMeshDataCreate()) {
    dGeomTriMeshDataBuildDouble(data_, corners_.data(), sizeof(Vec3),
                                static_cast<int>(corners_.size()), indices_.data(),
                                static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
  }
  ~OdeMesh() { dGeomTriMeshDataDestroy(data_); }
  OdeMesh(const OdeMesh&) = delete;
  OdeMesh& operator=(const OdeMesh&) = delete;

  /// ODE wants the angles between faces where the mesh meets a convex body.
  void find_angles() {
    dGeomTriMeshDataPreprocess2(data_, 1u << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, nullptr);
  }
  dGeomID make_geom(dSpaceID space) const {
    return dCreateTriMesh(space, data_, nullptr, nullptr, nullptr);
  }

 private:
  std::vector<Vec3> corners_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID data_;
};

/// A floor as ODE's mesh.
inline std::unique_ptr<OdeMesh> ode_floor(const Floor& floor) {
  std::vector<dTriIndex> indices;
  for (const Floor::Triangle& t : floor.triangles()) {
    indices.insert(indices.end(), t.begin(), t.end());
  }
  return std::make_unique<OdeMesh>(floor.corners(), std::move(indices));
}

}  // namespace touchstone
