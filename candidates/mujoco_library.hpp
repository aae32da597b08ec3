#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <mujoco/mujoco.h>
#include <stdexcept>
#include <string>

namespace touchstone {

/// The model of a text of MJCF. Throws std::runtime_error with what MuJoCo says against it.
inline mjModel* load_mjcf(const std::string& xml) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "model.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  char error[512] = "";
  mjModel* const model = mj_loadXML("model.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(error);
  return model;
}

/// A model of MJCF with its data.
struct MujocoScene {
  explicit MujocoScene(const std::string& xml) : model(load_mjcf(xml)), data(mj_makeData(model)) {}
  ~MujocoScene() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  MujocoScene(const MujocoScene&) = delete;
  MujocoScene& operator=(const MujocoScene&) = delete;

  void place(std::ptrdiff_t geom, const double* position, const double* orientation) const {
    mju_copy3(data->geom_xpos + 3 * geom, position);
    mju_quat2Mat(data->geom_xmat + 9 * geom, orientation);
  }

  mjModel* model;
  mjData* data;
};

}  // namespace touchstone
