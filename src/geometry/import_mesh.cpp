#include "geometry/import_mesh.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cstdint>
#include <cstring>

#include "geometry/import_ply.h"
#include "geometry/merge_vertices.h"
#include "geometry/read_text.h"
#include "geometry/scan_obj.h"
#include "geometry/scan_stl.h"
#include "geometry/triangulate_polygon.h"

namespace sluice {

namespace {

namespace fs = std::filesystem;

Vec3 vec(const aiVector3D& x) {
  return {static_cast<double>(x.x), static_cast<double>(x.y), static_cast<double>(x.z)};
}

[[noreturn]] void throw_unreadable(const fs::path& file, const std::string& reason) {
  throw file_error(file, 0, "cannot be read", reason, "export the part again");
}

int part_named(TriMesh& mesh, const std::string& name) {
  const auto found = std::find(mesh.part_names.begin(), mesh.part_names.end(), name);
  if (found != mesh.part_names.end()) return static_cast<int>(found - mesh.part_names.begin());
  mesh.part_names.push_back(name);
  return static_cast<int>(mesh.part_names.size()) - 1;
}

/// Adds an assimp mesh as triangles of one part; returns how many.
std::size_t add_mesh(const aiMesh& from, const Eigen::Affine3d& place, int part, TriMesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (unsigned v = 0; v < from.mNumVertices; ++v) mesh.vertices.push_back(place * vec(from.mVertices[v]));
  std::size_t added = 0;
  for (unsigned f = 0; f < from.mNumFaces; ++f) {
    const aiFace& face = from.mFaces[f];
    if (face.mNumIndices != 3) continue;  // points and lines have no surface
    std::array<int, 3> corners;
    for (unsigned k = 0; k < 3; ++k) corners[k] = first + static_cast<int>(face.mIndices[k]);
    mesh.triangles.push_back(corners);
    mesh.part.push_back(part);
    ++added;
  }
  return added;
}

TriMesh import_stl(const fs::path& file, const std::string& bytes) {
  TriMesh mesh;
  for (const StlScan::Solid& solid : scan_stl(file, bytes).solids) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFileFromMemory(solid.text.data(), solid.text.size(), 0, "stl");
    if (!scene) throw_unreadable(file, importer.GetErrorString());
    const int part = part_named(mesh, solid.name.empty() ? file.stem().string() : solid.name);
    std::size_t facets = 0;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m)
      facets += add_mesh(*scene->mMeshes[m], Eigen::Affine3d::Identity(), part, mesh);
    if (facets != solid.facets)
      throw_unreadable(file, fmt::format("{} of its {} facets were read", facets, solid.facets));
  }
  return mesh;
}

/// @param line  of the polygon, 0 where it has none
void add_polygon(const fs::path& file, int line, const std::vector<int>& corners, int part, TriMesh& mesh) {
  const auto triangles = triangulate_polygon(mesh.vertices, corners);
  if (!triangles)
    throw file_error(
        file, line,
        fmt::format("has a facet of {} corners that cannot be cut into triangles", corners.size()),
        "it crosses itself or has no area", "export the part as triangles");
  for (const auto& triangle : *triangles) {
    mesh.triangles.push_back(triangle);
    mesh.part.push_back(part);
  }
}

TriMesh import_obj(const fs::path& file, const std::string& bytes) {
  ObjScan scan = scan_obj(file, bytes);
  TriMesh mesh;
  mesh.vertices = std::move(scan.vertices);
  mesh.part_names = std::move(scan.part_names);
  for (const ObjScan::Face& face : scan.faces) add_polygon(file, face.line, face.corners, face.part, mesh);
  return mesh;
}

TriMesh import_ply_mesh(const fs::path& file, const std::string& bytes) {
  PolygonSoup soup = import_ply(file, bytes);
  TriMesh mesh;
  mesh.vertices = std::move(soup.vertices);
  mesh.part_names = {file.stem().string()};
  for (const auto& polygon : soup.polygons) add_polygon(file, 0, polygon, 0, mesh);
  return mesh;
}

/// A GLB's header holds its length (glTF 2.0 specification, section 4.4.2).
void check_glb(const fs::path& file, const std::string& bytes) {
  std::uint32_t words[3] = {0, 0, 0};  // magic, version, length; little-endian as this processor is
  std::memcpy(words, bytes.data(), std::min(bytes.size(), sizeof words));
  constexpr std::uint32_t magic = 0x46546C67;
  if (words[0] != magic)
    throw file_error(file, 0, "does not start with 'glTF'", "a GLB file does", "export it again");
  if (words[2] != bytes.size())
    throw file_error(file, 0, fmt::format("has {} bytes", bytes.size()),
                     fmt::format("its header states {}; it is truncated", words[2]),
                     "export or copy it again");
}

void add_node(const aiScene& scene, const aiNode& node, const Eigen::Affine3d& parent,
              const std::string& fallback, TriMesh& mesh) {
  Eigen::Affine3d place = parent;
  Eigen::Matrix4d own;
  const aiMatrix4x4& t = node.mTransformation;
  for (unsigned i = 0; i < 4; ++i)
    for (unsigned j = 0; j < 4; ++j) own(i, j) = static_cast<double>(t[i][j]);
  place = place * Eigen::Affine3d(own);
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& from = *scene.mMeshes[node.mMeshes[m]];
    std::string name = node.mName.C_Str();
    if (name.empty()) name = from.mName.length > 0 ? from.mName.C_Str() : fallback;
    add_mesh(from, place, part_named(mesh, name), mesh);
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) add_node(scene, *node.mChildren[c], place, fallback, mesh);
}

TriMesh import_gltf(const fs::path& file) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (!scene || !scene->mRootNode) throw_unreadable(file, importer.GetErrorString());
  TriMesh mesh;
  add_node(*scene, *scene->mRootNode, Eigen::Affine3d::Identity(), file.stem().string(), mesh);
  return mesh;
}

TriMesh import_by_kind(const fs::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::string bytes = read_bytes(file);
  if (kind == ".stl") return import_stl(file, bytes);
  if (kind == ".obj") return import_obj(file, bytes);
  if (kind == ".ply") return import_ply_mesh(file, bytes);
  if (kind == ".glb") check_glb(file, bytes);
  if (kind == ".glb" || kind == ".gltf") return import_gltf(file);
  throw file_error(file, 0, fmt::format("has the unknown extension '{}'", kind),
                   "STL, OBJ, PLY, glTF and GLB are read", "export the part as one of these");
}

/// Part names without a triangle are no parts.
void drop_empty_parts(TriMesh& mesh) {
  std::vector<int> number(mesh.part_names.size(), -1);
  for (int p : mesh.part) number[static_cast<std::size_t>(p)] = 0;
  std::vector<std::string> kept;
  for (std::size_t p = 0; p < number.size(); ++p) {
    if (number[p] < 0) continue;
    number[p] = static_cast<int>(kept.size());
    kept.push_back(mesh.part_names[p]);
  }
  for (int& p : mesh.part) p = number[static_cast<std::size_t>(p)];
  mesh.part_names = std::move(kept);
}

/// What every file has to pass, whoever read it.
void check_mesh(const fs::path& file, const TriMesh& mesh) {
  if (mesh.triangles.empty())
    throw file_error(file, 0, "has no triangles", "a surface is needed", "export the part as a mesh");
  const int vertices = static_cast<int>(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int v : mesh.triangles[t]) {
      if (v < 0 || v >= vertices)
        throw file_error(file, 0, fmt::format("facet {} names vertex {}", t + 1, v + 1),
                         fmt::format("there are {} vertices", vertices), "export the part again");
      if (!mesh.vertices[static_cast<std::size_t>(v)].allFinite())
        throw file_error(file, 0, fmt::format("facet {} has a vertex that is not finite", t + 1),
                         "a coordinate is NaN or infinite", "repair the part in the CAD program");
    }
}

}  // namespace

TriMesh import_mesh(const fs::path& file, double unit_in_metres) {
  TriMesh mesh;
  try {
    mesh = import_by_kind(file);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw_unreadable(file, e.what());
  }
  check_mesh(file, mesh);
  drop_empty_parts(mesh);
  for (Vec3& x : mesh.vertices) x *= unit_in_metres;
  merge_equal_vertices(mesh);
  return mesh;
}

}  // namespace sluice
