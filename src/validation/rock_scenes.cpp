#include "validation/rock_scenes.h"

namespace sluice {

namespace {

DemConfig config_of(const RockSetup& setup) {
  DemConfig config;
  config.stiffness_per_size = setup.stiffness_per_size;
  config.tangential_ratio = setup.tangential_ratio;
  config.end_of_contact = setup.end;
  config.overlap_limit = 1;
  return config;
}

DemScene scene_of(const RockSetup& setup) {
  DemScene scene;
  scene.materials.all = setup.rocks;
  scene.materials.all.push_back(setup.wall);
  scene.materials.pairs.assign(scene.materials.all.size() * scene.materials.all.size(), setup.pair);
  scene.shapes = setup.shapes;
  scene.domain.box = setup.box;
  scene.domain.low = scene.domain.high = setup.faces;
  scene.gravity = setup.gravity;
  scene.smallest_size = setup.smallest;
  scene.largest_size = setup.largest;
  for (const Material& rock : setup.rocks) scene.densest = std::max(scene.densest, rock.density);
  return scene;
}

}  // namespace

RockScene::RockScene(const RockSetup& setup, std::vector<Wall> all)
    : walls(std::move(all)), dem(std::make_unique<DemSystem>(config_of(setup), scene_of(setup), walls)) {}

Wall level_wall(const RockSetup& setup, double height, double half_width) {
  const double w = half_width;
  Wall wall;
  wall.name = "level";
  wall.material = static_cast<int>(setup.rocks.size());
  wall.mesh = make_rectangle(
      "level", {Vec3(-w, -w, height), Vec3(w, -w, height), Vec3(w, w, height), Vec3(-w, w, height)});
  return wall;
}

Wall box_wall(const RockSetup& setup, const Box& box) {
  Wall wall;
  wall.name = "box";
  wall.material = static_cast<int>(setup.rocks.size());
  wall.mesh = make_box("box", box);
  return wall;
}

}  // namespace sluice
