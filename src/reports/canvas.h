#pragma once
/// A software renderer: triangles, balls and lines into a depth buffer, no display needed.
///
/// Three layers are kept apart until the end: solids (rocks), water (shown through, above what lies
/// behind it) and glass (walls: blended without regard to order). One thread, no randomness: the same
/// scene gives the same pixels.

#include <array>
#include <vector>

#include "reports/colour.h"
#include "reports/png.h"

namespace sluice {

/// Tangent of half the vertical opening of a perspective camera (30 degrees: little distortion).
inline constexpr double half_angle_tangent = 0.27;

enum class Projection { perspective, orthographic };

struct Camera {
  Projection projection = Projection::perspective;
  Vec3 eye = Vec3(0, -1, 0);
  Vec3 target = Vec3::Zero();
  Vec3 up = Vec3::UnitZ();
  double view_height = 1;  ///< what fits between top and bottom at the target [m]
};

/// A corner of a triangle to be drawn.
struct Corner {
  Vec3 x = Vec3::Zero();       ///< [m]
  Vec3 normal = Vec3::Zero();  ///< unit
};

class Canvas {
 public:
  /// @param supersampling  each pixel is the mean of its square
  Canvas(int width, int height, int supersampling, const Camera& camera);

  void solid(const std::array<Corner, 3>& triangle, const Colour& colour);
  /// @param radius  [m]
  void water_ball(const Vec3& x, double radius, const Colour& colour);
  void glass(const std::array<Vec3, 3>& triangle, const Colour& colour, float alpha);
  /// Line of `width` final pixels; hidden by solids.
  void line(const Vec3& from, const Vec3& to, const Colour& colour, float alpha, double width);

  /// Pixels a length at this place covers, before supersampling is undone.
  double pixels_of(const Vec3& at, double length) const;

  Image finish() const;

 private:
  struct Projected {
    double x = 0, y = 0;  ///< fine pixels from the top left
    double depth = 0;     ///< distance along the view, grows away from the eye [m]
    double scale = 0;     ///< fine pixels per metre
    bool in_front = false;
  };
  Projected project(const Vec3& x) const;
  Colour shade(const Colour& colour, const Vec3& normal, float shininess) const;
  float occlusion(int x, int y) const;
  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_, height_, supersampling_;
  Camera camera_;
  Vec3 right_, up_, forward_;
  double focal_ = 0;  ///< fine pixels (perspective), or fine pixels per metre
  std::vector<float> solid_depth_, water_depth_;
  std::vector<Colour> solid_colour_, water_colour_, glass_colour_;
  std::vector<float> glass_weight_, glass_through_;
};

}  // namespace sluice
