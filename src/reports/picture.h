#pragma once
/// Pictures of a run's last state.

#include <optional>
#include <string>
#include <vector>

#include "output/view.h"
#include "reports/canvas.h"

namespace sluice {

struct PictureSize {
  int width = 1200, height = 900;  ///< pixels
  int supersampling = 2;
};

/// What the colours of a picture mean.
struct SpeedScale {
  double fastest = 0;  ///< colour 1; faster is drawn alike [m/s]
};
/// A round speed that 98 % of what is coloured stays below. @param view  water, or rocks where it is dry
SpeedScale speed_scale(const View& view);

/// The directions of a scene: gravity gives up; the exits, or the proportions, give its width.
struct SceneFrame {
  Box bounds;  ///< of walls, rocks and water [m]
  Vec3 up = Vec3::UnitZ();
  Vec3 across = Vec3::UnitY();  ///< along the width of the exits, horizontal
  Vec3 along = Vec3::UnitX();   ///< towards the exits, horizontal
};
SceneFrame scene_frame(const View& view);

Camera overview_camera(const SceneFrame& frame, const PictureSize& size);
/// Across the flow, orthographic: lengths can be taken from it.
Camera side_camera(const SceneFrame& frame, const PictureSize& size);
/// From beyond the exit, against the flow.
Camera exit_camera(const SceneFrame& frame, const PictureSize& size);

/// Rocks as their real shapes, water as balls coloured by speed, walls as tinted glass with their edges.
Image draw_picture(const View& view, const Camera& camera, const SpeedScale& scale, const PictureSize& size);

}  // namespace sluice
