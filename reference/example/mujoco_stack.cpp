// Five cans stand on one another. In MuJoCo the stack falls; with one line it stands.
#include <cstdio>
#include <fstream>
#include <touchstone/engines/mujoco.hpp>

void report(const char* name) {
  std::ofstream file("stack.xml");
  file << "<mujoco><worldbody><geom type='plane' size='1 1 1'/>";
  for (const char* height : {"0.05", "0.15", "0.25", "0.35", "0.45"}) {
    file << "<body pos='0 0 " << height << "'><freejoint/>"
         << "<geom type='cylinder' size='0.03 0.05' mass='0.3'/></body>";
  }
  file << "</worldbody></mujoco>" << std::flush;
  char error[500] = "";
  mjModel* const model = mj_loadXML("stack.xml", nullptr, error, sizeof error);
  mjData* const data = mj_makeData(model);
  while (data->time < 10) mj_step(model, data);
  const mjtNum *top = data->qpos + 4 * 7, *velocity = data->qvel + 4 * 6;
  std::printf("%s: top can at %.2f m, %.3f m/s\n", name, top[2], mju_norm3(velocity));
  mj_deleteData(data);
  mj_deleteModel(model);
}

int main() {
  report("MuJoCo");
  touchstone::mujoco::install();  // the line
  report("with Touchstone");
}
