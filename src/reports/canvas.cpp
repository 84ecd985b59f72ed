#include "reports/canvas.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice {
namespace {

constexpr float far_away = std::numeric_limits<float>::infinity();
constexpr float water_cover = 0.72F;  // how much of what lies behind water it hides
const Colour sky_top(0.99F, 0.995F, 1.0F), sky_bottom(0.86F, 0.89F, 0.92F);

}  // namespace

Canvas::Canvas(int width, int height, int supersampling, const Camera& camera)
    : width_(width * supersampling),
      height_(height * supersampling),
      supersampling_(supersampling),
      camera_(camera) {
  forward_ = (camera.target - camera.eye).normalized();
  right_ = forward_.cross(camera.up).normalized();
  up_ = right_.cross(forward_);
  focal_ = camera.projection == Projection::perspective ? 0.5 * height_ / half_angle_tangent
                                                        : height_ / camera.view_height;
  if (camera.projection == Projection::perspective)
    camera_.eye = camera.target - forward_ * (0.5 * camera.view_height / half_angle_tangent);
  const std::size_t n = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  solid_depth_.assign(n, far_away);
  water_depth_.assign(n, far_away);
  solid_colour_.assign(n, Colour::Zero());
  water_colour_.assign(n, Colour::Zero());
  glass_colour_.assign(n, Colour::Zero());
  glass_weight_.assign(n, 0);
  glass_through_.assign(n, 1);
}

Canvas::Projected Canvas::project(const Vec3& x) const {
  const Vec3 d = x - camera_.eye;
  Projected p;
  p.depth = d.dot(forward_);
  const bool perspective = camera_.projection == Projection::perspective;
  p.in_front = !perspective || p.depth > 1e-3 * camera_.view_height;
  p.scale = perspective ? focal_ / p.depth : focal_;
  p.x = 0.5 * width_ + p.scale * d.dot(right_);
  p.y = 0.5 * height_ - p.scale * d.dot(up_);
  return p;
}

double Canvas::pixels_of(const Vec3& at, double length) const {
  const Projected p = project(at);
  return p.in_front ? p.scale * length : 0;
}

Colour Canvas::shade(const Colour& colour, const Vec3& normal, float shininess) const {
  // a key light over the left shoulder, a fill from the right, light from the sky
  const Vec3 key = (-0.6 * right_ + 0.9 * up_ - 0.8 * forward_).normalized();
  const Vec3 fill = (0.8 * right_ + 0.1 * up_ - 0.6 * forward_).normalized();
  const auto positive = [](double x) { return static_cast<float>(std::max(0.0, x)); };
  const float light = 0.42F + 0.62F * positive(normal.dot(key)) + 0.16F * positive(normal.dot(fill)) +
                      0.10F * static_cast<float>(normal.dot(up_));
  const Vec3 halfway = (key - forward_).normalized();
  const float gloss = shininess * std::pow(positive(normal.dot(halfway)), 40.0F);
  return colour * light + Colour::Constant(gloss);
}

void Canvas::solid(const std::array<Corner, 3>& triangle, const Colour& colour) {
  std::array<Projected, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = project(triangle[k].x);
    if (!p[k].in_front) return;
  }
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  if (std::abs(area) < 1e-12) return;
  const auto [x_low, x_high] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [y_low, y_high] = std::minmax({p[0].y, p[1].y, p[2].y});
  const int x0 = std::max(0, static_cast<int>(std::floor(x_low))),
            x1 = std::min(width_ - 1, static_cast<int>(x_high));
  const int y0 = std::max(0, static_cast<int>(std::floor(y_low))),
            y1 = std::min(height_ - 1, static_cast<int>(y_high));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double w0 = ((p[1].x - px) * (p[2].y - py) - (p[2].x - px) * (p[1].y - py)) / area;
      const double w1 = ((p[2].x - px) * (p[0].y - py) - (p[0].x - px) * (p[2].y - py)) / area;
      const double w2 = 1 - w0 - w1;
      if (w0 < 0 || w1 < 0 || w2 < 0) continue;
      const auto depth = static_cast<float>(w0 * p[0].depth + w1 * p[1].depth + w2 * p[2].depth);
      const std::size_t at = place(x, y);
      if (depth >= solid_depth_[at]) continue;
      const Vec3 normal =
          (w0 * triangle[0].normal + w1 * triangle[1].normal + w2 * triangle[2].normal).normalized();
      solid_depth_[at] = depth;
      solid_colour_[at] = shade(colour, normal, 0.06F);
    }
  }
}

void Canvas::water_ball(const Vec3& x, double radius, const Colour& colour) {
  const Projected p = project(x);
  if (!p.in_front) return;
  const double r = std::max(0.75, radius * p.scale);
  const int x0 = std::max(0, static_cast<int>(p.x - r)), x1 = std::min(width_ - 1, static_cast<int>(p.x + r));
  const int y0 = std::max(0, static_cast<int>(p.y - r)),
            y1 = std::min(height_ - 1, static_cast<int>(p.y + r));
  for (int iy = y0; iy <= y1; ++iy) {
    for (int ix = x0; ix <= x1; ++ix) {
      const double dx = (ix + 0.5 - p.x) / r, dy = (p.y - iy - 0.5) / r;
      const double inside = 1 - dx * dx - dy * dy;
      if (inside < 0) continue;
      const double towards = std::sqrt(inside);
      const auto depth = static_cast<float>(p.depth - radius * towards);
      const std::size_t at = place(ix, iy);
      if (depth >= water_depth_[at]) continue;
      water_depth_[at] = depth;
      water_colour_[at] = shade(colour, dx * right_ + dy * up_ - towards * forward_, 0.35F);
    }
  }
}

void Canvas::glass(const std::array<Vec3, 3>& triangle, const Colour& colour, float alpha) {
  std::array<Projected, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = project(triangle[k]);
    if (!p[k].in_front) return;
  }
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  if (std::abs(area) < 1e-12) return;
  Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  if (normal.dot(forward_) > 0) normal = -normal;  // two-sided
  // seen along its surface, a plate is denser
  const float grazing = 1 - static_cast<float>(std::abs(normal.dot(forward_)));
  const float cover = std::min(0.9F, alpha * (1 + 1.6F * grazing * grazing));
  const Colour lit = shade(colour, normal, 0);
  const auto [x_low, x_high] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [y_low, y_high] = std::minmax({p[0].y, p[1].y, p[2].y});
  const int x0 = std::max(0, static_cast<int>(std::floor(x_low))),
            x1 = std::min(width_ - 1, static_cast<int>(x_high));
  const int y0 = std::max(0, static_cast<int>(std::floor(y_low))),
            y1 = std::min(height_ - 1, static_cast<int>(y_high));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double w0 = ((p[1].x - px) * (p[2].y - py) - (p[2].x - px) * (p[1].y - py)) / area;
      const double w1 = ((p[2].x - px) * (p[0].y - py) - (p[0].x - px) * (p[2].y - py)) / area;
      const double w2 = 1 - w0 - w1;
      if (w0 < 0 || w1 < 0 || w2 < 0) continue;
      // perspective: 1/depth is linear on the screen
      const double depth = camera_.projection == Projection::perspective
                               ? 1 / (w0 / p[0].depth + w1 / p[1].depth + w2 / p[2].depth)
                               : w0 * p[0].depth + w1 * p[1].depth + w2 * p[2].depth;
      const std::size_t at = place(x, y);
      if (static_cast<float>(depth) >= solid_depth_[at]) continue;
      // water hides glass behind it as it hides everything
      const float part = static_cast<float>(depth) > water_depth_[at] ? cover * (1 - water_cover) : cover;
      glass_colour_[at] += lit * part;
      glass_weight_[at] += part;
      glass_through_[at] *= 1 - part;
    }
  }
}

void Canvas::line(const Vec3& from, const Vec3& to, const Colour& colour, float alpha, double width) {
  const Projected a = project(from), b = project(to);
  if (!a.in_front || !b.in_front) return;
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const int steps = static_cast<int>(std::min(20000.0, std::ceil(length * 1.5))) + 1;
  const int reach = std::max(0, static_cast<int>(std::lround((width * supersampling_ - 1) / 2)));
  const double margin = 2e-3 * camera_.view_height;  // a line lies on its own surface
  int last_x = -1, last_y = -1;
  for (int k = 0; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    const int x = static_cast<int>(a.x + t * (b.x - a.x)), y = static_cast<int>(a.y + t * (b.y - a.y));
    if (x == last_x && y == last_y) continue;
    last_x = x;
    last_y = y;
    const auto depth = static_cast<float>(a.depth + t * (b.depth - a.depth) - margin);
    for (int j = y - reach; j <= y + reach; ++j) {
      for (int i = x - reach; i <= x + reach; ++i) {
        if (i < 0 || j < 0 || i >= width_ || j >= height_) continue;
        const std::size_t at = place(i, j);
        if (depth >= solid_depth_[at]) continue;
        const float part = depth > water_depth_[at] ? alpha * (1 - water_cover) : alpha;
        glass_colour_[at] += colour * part;
        glass_weight_[at] += part;
        glass_through_[at] *= 1 - part;
      }
    }
  }
}

/// Darkens what lies deeper than its neighbours (eye-dome lighting, Boucheny 2009): shape without shadows.
float Canvas::occlusion(int x, int y) const {
  const auto nearest = [&](int i, int j) {
    const std::size_t at = place(std::clamp(i, 0, width_ - 1), std::clamp(j, 0, height_ - 1));
    return std::min(solid_depth_[at], water_depth_[at]);
  };
  const float here = nearest(x, y);
  const auto scale = static_cast<float>(0.02 * camera_.view_height);
  float sum = 0;
  for (const int radius : {2, 5}) {
    for (int k = 0; k < 8; ++k) {
      static constexpr std::array<int, 8> dx = {1, 1, 0, -1, -1, -1, 0, 1}, dy = {0, 1, 1, 1, 0, -1, -1, -1};
      const auto d = static_cast<std::size_t>(k);
      const float there = nearest(x + dx[d] * radius, y + dy[d] * radius);
      if (there < here) sum += std::min(1.0F, (here - there) / scale);
    }
  }
  return std::exp(-0.09F * sum);
}

Image Canvas::finish() const {
  const int s = supersampling_;
  Image image{width_ / s, height_ / s, {}};
  image.rgb.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  for (int y = 0; y < image.height; ++y) {
    const float height = static_cast<float>(y) / static_cast<float>(image.height);
    const Colour sky = sky_top * (1 - height) + sky_bottom * height;
    for (int x = 0; x < image.width; ++x) {
      Colour sum = Colour::Zero();
      for (int k = 0; k < s * s; ++k) {
        const int fx = x * s + k % s, fy = y * s + k / s;
        const std::size_t at = place(fx, fy);
        const bool rock = solid_depth_[at] < far_away, water = water_depth_[at] < far_away;
        Colour c = rock ? solid_colour_[at] : sky;
        if (water && water_depth_[at] < solid_depth_[at])
          c = c * (1 - water_cover) + water_colour_[at] * water_cover;
        if (rock || water) c *= occlusion(fx, fy);
        if (glass_weight_[at] > 0)
          c = c * glass_through_[at] + glass_colour_[at] / glass_weight_[at] * (1 - glass_through_[at]);
        sum += c.cwiseMin(1.0F).cwiseMax(0.0F);
      }
      const Colour mean = sum / static_cast<float>(s * s);
      for (int k = 0; k < 3; ++k)
        image.rgb.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(mean[k], 0.0F, 1.0F) * 255)));
    }
  }
  return image;
}

}  // namespace sluice
