#include "geometry/surface_query.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/segment_triangle.h"

namespace sluice {

namespace {

/// Embree works in float about the centre of the mesh: a coordinate there is rounded by 6e-8 of the
/// scene's half diagonal. Boxes and reaches are widened by ten times that and more.
constexpr double margin_share = 2e-6;

struct Corners {
  Vec3 a, b, c;
};

}  // namespace

struct SurfaceQuery::Implementation {
  std::vector<Corners> triangles;
  Box bounds;
  Vec3 centre = Vec3::Zero();
  double margin = 0;  ///< [m]
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  explicit Implementation(const TriMesh& mesh);
  ~Implementation();
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  Box box_of(std::size_t t) const {
    Box box;
    box.include(triangles[t].a);
    box.include(triangles[t].b);
    box.include(triangles[t].c);
    return box;
  }
  Vec3f local(const Vec3& x) const { return (x - centre).cast<float>(); }
  template <class Visit>
  void near_point(const Vec3& x, double reach, Visit& visit) const;
  template <class Visit>
  void along_segment(const Vec3& a, const Vec3& b, Visit& visit) const;
};

namespace {

/// Point query: visit(triangle) returns the reach still of interest [m].
template <class Visit>
struct PointVisit {
  Visit* visit;
  double margin;
};

template <class Visit>
bool on_point_candidate(RTCPointQueryFunctionArguments* args) {
  auto& self = *static_cast<PointVisit<Visit>*>(args->userPtr);
  const double reach = (*self.visit)(static_cast<int>(args->primID));
  const float radius = static_cast<float>(reach * (1 + 1e-6) + self.margin);
  if (!(radius < args->query->radius)) return false;
  args->query->radius = radius;
  return true;
}

/// Ray query: visit(triangle) returns the part of the segment still of interest, 0 to 1.
struct RayVisit {
  RTCIntersectContext context;  // first: Embree hands this address back
  double (*call)(void* visit, int triangle);
  void* visit;
  double scale;   ///< of the whole segment to the clipped one
  double offset;  ///< start of the clipped segment
  double margin;  ///< in the parameter of the clipped segment
};

void on_ray_candidate(const RTCIntersectFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  auto& self = *reinterpret_cast<RayVisit*>(args->context);
  const double s = self.call(self.visit, static_cast<int>(args->primID));
  const double t = (s - self.offset) * self.scale * (1 + 1e-6) + self.margin;
  float& t_far = RTCRayN_tfar(RTCRayHitN_RayN(args->rayhit, args->N), args->N, 0);
  if (t < static_cast<double>(t_far)) t_far = static_cast<float>(t);
}

}  // namespace

SurfaceQuery::Implementation::Implementation(const TriMesh& mesh) : bounds(mesh.bounds()) {
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    triangles.push_back({mesh.vertices[static_cast<std::size_t>(t[0])],
                         mesh.vertices[static_cast<std::size_t>(t[1])],
                         mesh.vertices[static_cast<std::size_t>(t[2])]});
  if (triangles.empty()) return;
  centre = bounds.centre();
  margin = margin_share * 0.5 * bounds.size().norm() + 1e-30;

  device = rtcNewDevice("threads=1");  // built by one thread: the same tree every time
  if (!device) throw std::runtime_error("Embree cannot start");
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(triangles.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* args) {
        const auto& self = *static_cast<const Implementation*>(args->geometryUserPtr);
        const Box box = self.box_of(args->primID).grown(self.margin);
        const Vec3f lo = self.local(box.lo), hi = self.local(box.hi);
        *args->bounds_o = {lo.x(), lo.y(), lo.z(), 0, hi.x(), hi.y(), hi.z(), 0};
      },
      nullptr);
  rtcSetGeometryIntersectFunction(geometry, on_ray_candidate);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build the scene");
}

SurfaceQuery::Implementation::~Implementation() {
  if (scene) rtcReleaseScene(scene);
  if (device) rtcReleaseDevice(device);
}

template <class Visit>
void SurfaceQuery::Implementation::near_point(const Vec3& x, double reach, Visit& visit) const {
  const Vec3f local_x = local(x);
  // Beyond the scene the rounding of x grows with its distance.
  const double widened = margin + 2e-7 * (x - centre).norm();
  RTCPointQuery query{local_x.x(), local_x.y(), local_x.z(), 0,
                      static_cast<float>(std::min(reach * (1 + 1e-6) + widened, 1e30))};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  PointVisit<Visit> user{&visit, widened};
  rtcPointQuery(scene, &query, &context, on_point_candidate<Visit>, &user);
}

template <class Visit>
void SurfaceQuery::Implementation::along_segment(const Vec3& a, const Vec3& b, Visit& visit) const {
  // Clipped to the scene first, so that float coordinates stay small.
  const Box box = bounds.grown(2 * margin);
  const Vec3 d = b - a;
  double enter = 0, leave = 1;
  for (int k = 0; k < 3; ++k) {
    if (d[k] == 0) {
      if (a[k] < box.lo[k] || a[k] > box.hi[k]) return;
      continue;
    }
    const double s0 = (box.lo[k] - a[k]) / d[k], s1 = (box.hi[k] - a[k]) / d[k];
    enter = std::max(enter, std::min(s0, s1));
    leave = std::min(leave, std::max(s0, s1));
  }
  if (!(enter <= leave)) return;
  const double length = (leave - enter) * d.norm();
  const Vec3f origin = local(a + enter * d), direction = ((leave - enter) * d).cast<float>();

  RayVisit user{};
  rtcInitIntersectContext(&user.context);
  user.call = [](void* v, int triangle) { return (*static_cast<Visit*>(v))(triangle); };
  user.visit = &visit;
  user.offset = enter;
  user.scale = leave > enter ? 1 / (leave - enter) : 1;
  user.margin = length > 0 ? std::min(margin / length, 1e6) : 1;
  RTCRayHit ray{};
  ray.ray.org_x = origin.x();
  ray.ray.org_y = origin.y();
  ray.ray.org_z = origin.z();
  ray.ray.dir_x = direction.x();
  ray.ray.dir_y = direction.y();
  ray.ray.dir_z = direction.z();
  ray.ray.tnear = 0;
  ray.ray.tfar = static_cast<float>(1 + std::min(user.margin, 1e6));
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &user.context, &ray);
}

SurfaceQuery::SurfaceQuery(const TriMesh& mesh) : implementation_(std::make_unique<Implementation>(mesh)) {}
SurfaceQuery::~SurfaceQuery() = default;

void SurfaceQuery::triangles_in(const Box& box, std::vector<int>& found) const {
  found.clear();
  const Implementation& self = *implementation_;
  if (self.triangles.empty() || box.empty() || !box.overlaps(self.bounds)) return;
  const Box part{box.lo.cwiseMax(self.bounds.lo), box.hi.cwiseMin(self.bounds.hi)};
  const double reach = 0.5 * part.size().norm();
  auto visit = [&](int t) {
    if (self.box_of(static_cast<std::size_t>(t)).overlaps(box)) found.push_back(t);
    return reach;
  };
  self.near_point(part.centre(), reach, visit);
  std::sort(found.begin(), found.end());
}

std::optional<NearestPoint> SurfaceQuery::nearest(const Vec3& x, double reach) const {
  const Implementation& self = *implementation_;
  if (self.triangles.empty()) return std::nullopt;
  NearestPoint best;
  best.distance = reach;
  auto visit = [&](int t) {
    const Corners& c = self.triangles[static_cast<std::size_t>(t)];
    const Vec3 point = closest_on_triangle(x, c.a, c.b, c.c);
    const double distance = (point - x).norm();
    if (distance < best.distance || (distance == best.distance && (best.triangle < 0 || t < best.triangle)))
      best = {t, point, distance};
    return best.distance;
  };
  self.near_point(x, reach, visit);
  return best.triangle < 0 ? std::nullopt : std::optional(best);
}

std::optional<SegmentHit> SurfaceQuery::first_hit(const Vec3& a, const Vec3& b) const {
  const Implementation& self = *implementation_;
  if (self.triangles.empty()) return std::nullopt;
  SegmentHit best;
  best.s = 1;
  auto visit = [&](int t) {
    const Corners& c = self.triangles[static_cast<std::size_t>(t)];
    const std::optional<double> s = segment_meets_triangle(a, b, c.a, c.b, c.c);
    if (s && (best.triangle < 0 || *s < best.s || (*s == best.s && t < best.triangle))) {
      best.triangle = t;
      best.s = *s;
    }
    return best.s;
  };
  // A ray shorter than the float margin has no direction worth tracing.
  const double length = (b - a).norm();
  if (length <= self.margin) {
    auto visit_all = [&](int t) {
      visit(t);
      return length;
    };
    self.near_point(a, length, visit_all);
  } else {
    self.along_segment(a, b, visit);
  }
  if (best.triangle < 0) return std::nullopt;
  best.point = a + best.s * (b - a);
  return best;
}

int SurfaceQuery::crossings(const Vec3& x, const Vec3& d) const {
  const Implementation& self = *implementation_;
  if (self.triangles.empty() || d.isZero(0)) return 0;
  // Ends beyond the scene.
  const double length = (x - self.centre).norm() + self.bounds.size().norm();
  const Vec3 end = x + (2 * length / d.norm()) * d;
  int count = 0;
  auto visit = [&](int t) {
    const Corners& c = self.triangles[static_cast<std::size_t>(t)];
    if (segment_crosses_once(x, end, c.a, c.b, c.c)) ++count;
    return 1.0;
  };
  self.along_segment(x, end, visit);
  return count;
}

bool SurfaceQuery::inside(const Vec3& x) const {
  if (!implementation_->bounds.contains(x)) return false;
  // Directions without a small ratio between their components, so that CAD's edges are not met.
  const Vec3 rays[3] = {{0.7548776, 0.5698403, 0.3249180},
                        {-0.4142136, 0.7320508, -0.5411961},
                        {0.2360680, -0.6180340, 0.7498942}};
  int votes = 0;
  for (const Vec3& d : rays) votes += crossings(x, d) % 2;
  return votes >= 2;
}

}  // namespace sluice
