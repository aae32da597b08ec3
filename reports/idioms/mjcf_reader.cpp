// Reads a file of export --as mjcf by MuJoCo, and says of each pair whether it is answered as the
// file expects: mjcf_reader FILE. With RIGHT in the environment our contacts stand in MuJoCo's
// place, with the fault that RIGHT names (idiom_test.py).
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <mujoco/mujoco.h>
#include <stdexcept>
#include <string>
#include <variant>

#include "reference/engines/mujoco.hpp"
#include "reports/idioms/cases.hpp"

namespace touchstone {
namespace {

const mjtNum* numbers(const mjModel* model, const std::string& name) {
  const int i = mj_name2id(model, mjOBJ_NUMERIC, name.c_str());
  if (i < 0) throw std::runtime_error("no numeric " + name);
  return model->numeric_data + model->numeric_adr[i];
}

std::string text(const mjModel* model, const std::string& name) {
  const int i = mj_name2id(model, mjOBJ_TEXT, name.c_str());
  if (i < 0) throw std::runtime_error("no text " + name);
  return model->text_data + model->text_adr[i];
}

Shape shape_of(const mjModel* model, int geom) {
  const mjtNum* const size = model->geom_size + std::ptrdiff_t{3} * geom;
  switch (model->geom_type[geom]) {
    case mjGEOM_PLANE:
      return mujoco::detail::shape_of<Plane>(size);
    case mjGEOM_SPHERE:
      return mujoco::detail::shape_of<Sphere>(size);
    case mjGEOM_CAPSULE:
      return mujoco::detail::shape_of<Capsule>(size);
    case mjGEOM_CYLINDER:
      return mujoco::detail::shape_of<Cylinder>(size);
    default:
      return mujoco::detail::shape_of<Box>(size);
  }
}

/// The contacts of two geoms, with normals from the second to the first one.
Answer answer_of(const mjData* data, int a, int b) {
  Answer answer{};
  answer.status = TS_NONE;
  for (int i = 0; i < data->ncon; ++i) {
    const mjContact& contact = data->contact[i];
    const bool a_is_first = contact.geom1 == a && contact.geom2 == b;
    if (!a_is_first && (contact.geom1 != b || contact.geom2 != a)) continue;
    ts_point& point = answer.points[answer.point_count++];
    for (int j = 0; j < 3; ++j) {
      point.position[j] = contact.pos[j];
      point.normal[j] = (a_is_first ? -1 : 1) * contact.frame[j];
    }
    point.depth = -contact.dist;
    if (answer.status == TS_CONTACT && contact.dist >= answer.signed_distance) continue;
    answer.status = TS_CONTACT;
    answer.signed_distance = contact.dist;
    for (int j = 0; j < 3; ++j) answer.normal[j] = point.normal[j];
  }
  return answer;
}

Answer with_fault(Answer answer, const std::string& fault) {
  if (fault == "missed") answer.status = TS_NONE;
  const double deeper = fault == "deeper" ? 1e-3 : 0;
  answer.signed_distance -= deeper;
  for (double& n : answer.normal) n *= fault == "reversed" ? -1 : 1;
  for (ts_point& point : answer.points) {
    point.depth += deeper;
    point.position[0] += fault == "moved" ? 9 : 0;
  }
  return answer;
}

/// Number of pairs that are answered otherwise than they should be.
int wrong_pairs(const mjModel* model, const mjData* data) {
  const char* const right = std::getenv("RIGHT");
  const std::string fault = right ? right : "";
  int wrong = 0;
  for (int i = 0; i < model->npair; ++i) {
    const std::string name = mj_id2name(model, mjOBJ_PAIR, i);
    const int a = mj_name2id(model, mjOBJ_GEOM, (name + ".a").c_str());
    const int b = mj_name2id(model, mjOBJ_GEOM, (name + ".b").c_str());
    const Configuration configuration{std::get<Cylinder>(shape_of(model, a)),
                                      mujoco::detail::pose_of(data, a), shape_of(model, b),
                                      mujoco::detail::pose_of(data, b)};
    const double distance = *numbers(model, name + ".distance");
    const double tolerance = *numbers(model, name + ".tolerance");
    const std::string expected = text(model, name + ".verdict");
    const std::string found =
        idiom_verdict(configuration, distance, tolerance, with_fault(answer_of(data, a, b), fault));
    std::printf("%s %s: %s\n", found == expected ? "ok" : "FAILED", name.c_str(), found.c_str());
    wrong += found != expected;
    // Along what the file calls a normal nothing is wrong but that there are no points.
    Answer along_normal = answer_of(data, a, b);
    along_normal.status = TS_CONTACT;
    along_normal.signed_distance = distance;
    along_normal.point_count = 0;
    const mjtNum* const normal = numbers(model, name + ".normal");
    std::copy_n(normal, 3, along_normal.normal);
    if (distance <= tolerance &&
        idiom_verdict(configuration, distance, tolerance, along_normal) != "no-points") {
      throw std::runtime_error(name + ".normal is none");
    }
  }
  return wrong;
}

int read(const char* file) {
  char error[512] = "";
  mjModel* const model = mj_loadXML(file, nullptr, error, sizeof error);
  if (!model) throw std::runtime_error(error);
  mjData* const data = mj_makeData(model);
  if (std::getenv("RIGHT")) mujoco::install();
  mj_forward(model, data);
  const int wrong = wrong_pairs(model, data);
  mj_deleteData(data);
  mj_deleteModel(model);
  return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace touchstone

int main(int, char** arguments) try {
  return touchstone::read(arguments[1]);
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}
