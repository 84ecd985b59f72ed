#include "geometry/merge_vertices.h"

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>

#include "base/random.h"

namespace sluice {

namespace {

using Key = std::array<std::uint64_t, 3>;

Key key_of(const Vec3& x) {
  Key key;
  for (int k = 0; k < 3; ++k) key[static_cast<std::size_t>(k)] = std::bit_cast<std::uint64_t>(x[k] + 0.0);
  return key;
}

struct Hash {
  std::size_t operator()(const Key& key) const { return mix64(key[0] ^ mix64(key[1] ^ mix64(key[2]))); }
};

}  // namespace

std::size_t merge_equal_vertices(TriMesh& mesh) {
  std::unordered_map<Key, int, Hash> first;
  std::vector<Vec3> kept;
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) {
      const Vec3& x = mesh.vertices[static_cast<std::size_t>(v)];
      const auto [entry, is_new] = first.try_emplace(key_of(x), static_cast<int>(kept.size()));
      if (is_new) kept.push_back(x);
      v = entry->second;
    }
  const std::size_t gone = mesh.vertices.size() - kept.size();
  mesh.vertices = std::move(kept);
  return gone;
}

}  // namespace sluice
