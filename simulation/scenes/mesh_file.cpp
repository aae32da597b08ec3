// The only file that includes assimp's headers.
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cctype>
#include <fmt/format.h>

#include "properties/files/disk.hpp"
#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/mesh.hpp"

namespace touchstone {
namespace {

Eigen::Affine3d to_affine(const aiMatrix4x4& m) {
  Eigen::Affine3d result;
  result.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1,
      m.d2, m.d3, m.d4;
  return result;
}

/// Adds the triangles of a node and of those below it.
void add_node(const aiScene& scene, const aiNode& node, const Eigen::Affine3d& X_WP, Mesh& mesh) {
  const Eigen::Affine3d X_WN = X_WP * to_affine(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
    const int first = static_cast<int>(mesh.points.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D& p = part.mVertices[v];
      mesh.points.emplace_back(X_WN * Vec3(p.x, p.y, p.z));
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // a point or a line
      const auto corner = [&](int k) { return first + static_cast<int>(face.mIndices[k]); };
      mesh.triangles.push_back({corner(0), corner(1), corner(2)});
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(scene, *node.mChildren[i], X_WN, mesh);
}

[[noreturn]] void refuse_mesh(const std::filesystem::path& file, const std::string& remedy) {
  throw InvalidInput("mesh", '"' + file.string() + '"', remedy);
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (ending != ".stl" && ending != ".obj" && ending != ".dae") {
    refuse_mesh(file, "must be STL, OBJ or COLLADA (.stl, .obj, .dae): save it as one of these");
  }
  opened(file, "mesh");  // which says why not
  now_reading(file.string());
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* const scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
  if (!scene || !scene->mRootNode) {
    constexpr std::size_t max_reason = 200;
    refuse_mesh(file, "must be a whole mesh; its reader says: " +
                          printable(importer.GetErrorString(), max_reason));
  }
  Mesh mesh;
  add_node(*scene, *scene->mRootNode, Eigen::Affine3d::Identity(), mesh);
  if (mesh.triangles.empty()) refuse_mesh(file, "must have triangles");
  for (const Vec3& p : mesh.points) {
    if (p.allFinite()) continue;
    refuse_mesh(file,
                fmt::format("must have finite coordinates, not ({}, {}, {})", p.x(), p.y(), p.z()));
  }
  return mesh;
}

}  // namespace touchstone
