#include "scene/rays/ray_scene.h"

#include <embree3/rtcore.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <limits>

namespace obscura::tools {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr unsigned kTriangles = 0, kSpheres = 1;  // Embree's geometry numbers

// Embree passes its own context to filters. This one has room for our data behind it.
struct GatherContext {
  RTCIntersectContext embree;
  std::vector<std::array<unsigned, 2>>* found;
};

// Notes every primitive that the ray touches and refuses it, so that the search goes on.
void gather(const RTCFilterFunctionNArguments* args) {
  auto* context = reinterpret_cast<GatherContext*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    context->found->push_back(
        {RTCHitN_geomID(args->hit, args->N, i), RTCHitN_primID(args->hit, args->N, i)});
    args->valid[i] = 0;
  }
}

RTCRayHit make_ray(const float o[3], const float d[3], float far) {
  RTCRayHit r{};
  r.ray.org_x = o[0];
  r.ray.org_y = o[1];
  r.ray.org_z = o[2];
  r.ray.dir_x = d[0];
  r.ray.dir_y = d[1];
  r.ray.dir_z = d[2];
  r.ray.tfar = far;
  r.ray.mask = ~0u;
  r.hit.geomID = r.hit.primID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return r;
}

RTCRayHit make_ray(Vec3 o, Vec3 d) {
  const float origin[3] = {float(o.x), float(o.y), float(o.z)};
  const float direction[3] = {float(d.x), float(d.y), float(d.z)};
  return make_ray(origin, direction, kInf);
}

std::vector<std::array<unsigned, 2>>& scratch() {
  thread_local std::vector<std::array<unsigned, 2>> found;
  found.clear();
  return found;
}

}  // namespace

struct RayScene::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Embree() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  std::vector<std::array<unsigned, 2>>& touched(Vec3 origin, Vec3 direction) const {
    auto& found = scratch();
    GatherContext context;
    rtcInitIntersectContext(&context.embree);
    context.embree.filter = gather;
    context.found = &found;
    RTCRayHit ray = make_ray(origin, direction);
    rtcIntersect1(scene, &context.embree, &ray);
    // Embree may show one primitive more than once.
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }
};

RayScene::RayScene(Mesh mesh)
    : mesh_(std::move(mesh)), bounds_(bounds_of(mesh_)), embree_(new Embree) {}
RayScene::~RayScene() = default;

Status RayScene::create(Mesh input, std::unique_ptr<RayScene>* scene, int threads) {
  std::unique_ptr<RayScene> made(new RayScene(std::move(input)));
  const Mesh& mesh = made->mesh_;
  Embree& e = *made->embree_;
  e.device = rtcNewDevice(nullptr);
  if (!e.device) return {StatusCode::kInternal, "Embree offers no device on this processor"};
  e.scene = rtcNewScene(e.device);
  // Robust: rays do not slip through edges. The context's filter collects all hits of a ray.
  rtcSetSceneFlags(e.scene,
                   RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  auto attach = [&](RTCGeometry geometry, unsigned id) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(e.scene, geometry, id);
    rtcReleaseGeometry(geometry);
  };
  if (!mesh.triangles.empty()) {
    RTCGeometry g = rtcNewGeometry(e.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Mesh::Point), mesh.positions.size());
    void* indices = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(Mesh::Triangle), mesh.triangles.size());
    if (!vertices || !indices) {
      rtcReleaseGeometry(g);
      return {StatusCode::kOutOfMemory, "out of memory while preparing the mesh for rays"};
    }
    std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<Mesh::Point*>(vertices));
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<Mesh::Triangle*>(indices));
    attach(g, kTriangles);
  }
  if (!mesh.spheres.empty()) {
    RTCGeometry g = rtcNewGeometry(e.device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
        g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), mesh.spheres.size()));
    for (const Mesh::Sphere& s : mesh.spheres) {
      for (double v : {s.center.x, s.center.y, s.center.z, s.radius}) *points++ = float(v);
    }
    attach(g, kSpheres);
  }
  // Embree works on TBB's threads; an arena says on how many. (The device's own limit would start
  // a thread when it ends.) TBB warns on stderr where an arena asks for more than there are.
  const int there = tbb::info::default_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, there) : there);
  arena.execute([&] { rtcCommitScene(e.scene); });
  if (rtcGetDeviceError(e.device) != RTC_ERROR_NONE) {
    return {StatusCode::kOutOfMemory, "Embree could not prepare the mesh for rays"};
  }
  *scene = std::move(made);
  return {};
}

int RayScene::part_of(std::size_t triangle) const {
  const auto after =
      std::upper_bound(mesh_.parts.begin(), mesh_.parts.end(), triangle,
                       [](std::size_t t, const Mesh::Part& p) { return t < p.first; });
  return int(after - mesh_.parts.begin()) - 1;
}

bool RayScene::refine(unsigned geometry, unsigned primitive, Vec3 origin, Vec3 direction,
                      Hit* hit) const {
  if (geometry == kSpheres) {
    // The nearer crossing in front of the origin.
    const Mesh::Sphere& s = mesh_.spheres[primitive];
    const Vec3 to_center = s.center - origin;
    const double dd = dot(direction, direction);
    const double middle = dot(to_center, direction) / dd;
    const Vec3 miss = to_center - direction * middle;
    const double half = std::sqrt(std::max(0.0, (s.radius * s.radius - dot(miss, miss)) / dd));
    hit->t = middle - half > 0 ? middle - half : middle + half;
    hit->normal = normalize(origin + direction * hit->t - s.center);
    hit->part = int(mesh_.parts.size() + primitive);
    return true;
  }
  const Mesh::Triangle& tri = mesh_.triangles[primitive];
  const Vec3 a = mesh_.position(tri.a), b = mesh_.position(tri.b), c = mesh_.position(tri.c);
  const Vec3 normal = cross(b - a, c - a);
  const double along = dot(normal, direction);
  hit->t = dot(normal, a - origin) / along;
  hit->normal = normal / length(normal);
  hit->part = part_of(primitive);
  return is_finite(hit->normal) && std::isfinite(hit->t);
}

bool RayScene::intersect(Vec3 origin, Vec3 direction, Hit* hit) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray = make_ray(origin, direction);
  rtcIntersect1(embree_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  unsigned geometry = ray.hit.geomID, primitive = ray.hit.primID;
  const float u = ray.hit.u, v = ray.hit.v;
  constexpr float kEdge = 1e-4f;  // in barycentric coordinates
  if (geometry == kTriangles && std::min({u, v, 1 - u - v}) < kEdge) {
    // Which of two triangles owns a common edge depends on the order in which Embree looks at
    // them. Take the one with the smallest number.
    for (const auto& [g, p] : embree_->touched(origin, direction)) {
      Hit other;
      if (g == kTriangles && refine(g, p, origin, direction, &other) &&
          std::abs(other.t - ray.ray.tfar) <= 1e-5 * std::abs(ray.ray.tfar)) {
        primitive = p;
        break;
      }
    }
  }
  if (!refine(geometry, primitive, origin, direction, hit)) {
    hit->t = ray.ray.tfar;
    hit->normal = normalize({ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z});
    if (!is_finite(hit->normal)) hit->normal = normalize(-direction);
  }
  return true;
}

void RayScene::intersect_all(Vec3 origin, Vec3 direction, std::vector<Hit>* hits) const {
  hits->clear();
  for (const auto& [geometry, primitive] : embree_->touched(origin, direction)) {
    Hit hit;
    if (!refine(geometry, primitive, origin, direction, &hit) || !(hit.t > 0)) continue;
    hits->push_back(hit);
    if (geometry == kSpheres && dot(hit.normal, direction) < 0) {
      const Mesh::Sphere& s = mesh_.spheres[primitive];
      const double middle = dot(s.center - origin, direction) / dot(direction, direction);
      hit.t = 2 * middle - hit.t;
      hit.normal = normalize(origin + direction * hit.t - s.center);
      hits->push_back(hit);
    }
  }
  std::stable_sort(hits->begin(), hits->end(),
                   [](const Hit& a, const Hit& b) { return a.t < b.t; });
}

void RayScene::distances(Vec3 origin, const Bundle& bundle, float far, bool nearest,
                         float distance[kLanes]) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  alignas(64) int valid[kLanes];
  alignas(64) RTCRayHit16 r;
  const float o[3] = {float(origin.x), float(origin.y), float(origin.z)};
  for (int i = 0; i < kLanes; ++i) {
    const int k = i < bundle.count ? i : 0;  // Embree checks the rays of unused lanes too
    valid[i] = i < bundle.count ? -1 : 0;
    r.ray.org_x[i] = o[0];
    r.ray.org_y[i] = o[1];
    r.ray.org_z[i] = o[2];
    r.ray.dir_x[i] = bundle.x[k];
    r.ray.dir_y[i] = bundle.y[k];
    r.ray.dir_z[i] = bundle.z[k];
    r.ray.tnear[i] = 0;
    r.ray.tfar[i] = far;
    r.ray.time[i] = 0;
    r.ray.mask[i] = ~0u;
    r.ray.id[i] = r.ray.flags[i] = 0;
    r.hit.geomID[i] = r.hit.primID[i] = r.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  if (nearest) {
    rtcIntersect16(valid, embree_->scene, &context, &r);
    for (int i = 0; i < bundle.count; ++i) {
      distance[i] = r.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? kInf : r.ray.tfar[i];
    }
  } else {
    rtcOccluded16(valid, embree_->scene, &context, &r.ray);
    for (int i = 0; i < bundle.count; ++i) distance[i] = r.ray.tfar[i] < 0 ? 0 : kInf;
  }
}

int RayScene::part_around(Vec3 point) const {
  // A ray from inside a closed part leaves it one time more than it enters it. The majority of
  // three directions decides, so that a grazed edge does no harm.
  const Vec3 directions[] = {{0.8, 0.33, -0.5}, {-0.45, 0.71, 0.54}, {-0.27, -0.61, -0.74}};
  std::vector<std::vector<int>> inside;
  std::vector<Hit> hits;
  for (const Vec3& direction : directions) {
    intersect_all(point, direction, &hits);
    std::vector<int>& parts = inside.emplace_back();
    std::stable_sort(hits.begin(), hits.end(),
                     [](const Hit& a, const Hit& b) { return a.part < b.part; });
    for (std::size_t i = 0; i < hits.size();) {
      const int part = hits[i].part;
      int balance = 0;
      for (; i < hits.size() && hits[i].part == part; ++i) {
        balance += dot(hits[i].normal, direction) > 0 ? 1 : -1;
      }
      if (balance > 0 && is_closed(part)) parts.push_back(part);
    }
  }
  for (int part : inside[0]) {
    const bool all = std::all_of(inside.begin(), inside.end(), [&](const std::vector<int>& v) {
      return std::find(v.begin(), v.end(), part) != v.end();
    });
    if (all) return part;
  }
  return -1;
}

}  // namespace obscura::tools
