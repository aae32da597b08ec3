#pragma once

#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"

namespace touchstone {

/// A configuration of critical_poses.jsonl: generators of another make found it wrong once. The
/// file says why; `replay critical_poses.jsonl` shows it.
struct CriticalPose {
  std::string name;
  Configuration configuration;
};

/// Those of which this was wrong: "distance" (or normal) or "points".
inline std::vector<CriticalPose> critical_poses(const std::string& what) {
  std::vector<CriticalPose> poses;
  std::ifstream file(TOUCHSTONE_CRITICAL_POSES);
  for (std::string line; std::getline(file, line);) {
    const auto row = nlohmann::json::parse(line);
    if (row["of"] != what) continue;
    poses.push_back({row["id"], configuration_from_json(row["configuration"]).configuration});
  }
  EXPECT_FALSE(poses.empty()) << "nothing of " << what << " in critical_poses.jsonl";
  return poses;
}

}  // namespace touchstone
