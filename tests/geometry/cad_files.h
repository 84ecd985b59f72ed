#pragma once
/// CAD files as text, for tests of reading and of damage.

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "geometry/tri_mesh.h"

namespace sluice {

template <class T>
void append_bytes(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

inline std::string binary_stl(const TriMesh& mesh, const std::string& header = "test") {
  std::string bytes = header;
  bytes.resize(80, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) append_bytes(bytes, 0.0f);
    for (int v : t)
      for (int k = 0; k < 3; ++k)
        append_bytes(bytes, static_cast<float>(mesh.vertices[static_cast<std::size_t>(v)][k]));
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

inline std::string text_stl_facet(const std::string& third = "0 1 0") {
  return "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex " + third +
         "\n endloop\nendfacet\n";
}

enum class PlyKind { text, little, big };

/// A tetrahedron with a quality per vertex and 32-bit indices.
inline std::string ply_tetrahedron(PlyKind kind, int stated_vertices = 4, int stated_faces = 4) {
  const char* format = kind == PlyKind::text     ? "ascii"
                       : kind == PlyKind::little ? "binary_little_endian"
                                                 : "binary_big_endian";
  std::string bytes = std::string("ply\nformat ") + format +
                      " 1.0\ncomment made for a test\nelement vertex " + std::to_string(stated_vertices) +
                      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar quality\n"
                      "element face " +
                      std::to_string(stated_faces) + "\nproperty list uchar int vertex_indices\nend_header\n";
  const float x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::int32_t f[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const auto put = [&](auto value) {
    std::string raw;
    append_bytes(raw, value);
    if (kind == PlyKind::big) raw = std::string(raw.rbegin(), raw.rend());
    bytes += raw;
  };
  for (const auto& p : x) {
    if (kind == PlyKind::text) {
      bytes += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + " 7\n";
      continue;
    }
    for (float c : p) put(c);
    put(std::uint8_t{7});
  }
  for (const auto& t : f) {
    if (kind == PlyKind::text) {
      bytes += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
      continue;
    }
    put(std::uint8_t{3});
    for (std::int32_t v : t) put(v);
  }
  return bytes;
}

inline std::string base64(const std::string& bytes) {
  static const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = (word << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : letters[(word >> (18 - 6 * k)) & 63];
  }
  return text;
}

/// One triangle, used by two nodes: `plate` moved by (10, 0, 0) under a parent that scales by two, and `lid`.
inline std::string gltf_two_nodes() {
  std::string buffer;
  for (float c : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) append_bytes(buffer, c);
  for (std::uint16_t i : {0, 1, 2}) append_bytes(buffer, i);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,2]}],
"nodes":[{"name":"frame","scale":[2,2,2],"children":[1]},{"name":"plate","mesh":0,"translation":[10,0,0]},
{"name":"lid","mesh":0}],
"meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"buffers":[{"byteLength":42,"uri":"data:application/octet-stream;base64,)" +
         base64(buffer) + "\"}]}";
}

}  // namespace sluice
