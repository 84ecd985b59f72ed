import { BufferAttribute, BufferGeometry, Vector3 } from 'three';

/** |x|^m + |y|^m + |z|^m = 1, drawn on the grid of a cube; semi-axes come with the instance's scale. */
export function superquadricGeometry(m: number, divisions: number): BufferGeometry {
  const positions: number[] = [], normals: number[] = [], triangles: number[] = [];
  const u = new Vector3(), n = new Vector3();
  for (let axis = 0; axis < 3; ++axis) {
    for (const side of [-1, 1]) {
      const first = positions.length / 3;
      for (let i = 0; i <= divisions; ++i) {
        for (let j = 0; j <= divisions; ++j) {
          const g = [0, 0, 0];
          g[axis] = side;
          g[(axis + 1) % 3] = Math.tan((2 * i / divisions - 1) * Math.PI / 4);
          g[(axis + 2) % 3] = Math.tan((2 * j / divisions - 1) * Math.PI / 4);
          const scale = Math.pow(g.reduce((s, x) => s + Math.pow(Math.abs(x), m), 0), -1 / m);
          u.set(g[0], g[1], g[2]).multiplyScalar(scale);
          const gradient = (x: number) => Math.sign(x) * Math.pow(Math.abs(x), m - 1);
          n.set(gradient(u.x), gradient(u.y), gradient(u.z)).normalize();
          positions.push(u.x, u.y, u.z);
          normals.push(n.x, n.y, n.z);
        }
      }
      const at = (i: number, j: number) => first + i * (divisions + 1) + j;
      for (let i = 0; i < divisions; ++i) {
        for (let j = 0; j < divisions; ++j) {
          const p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1), s = at(i, j + 1);
          if (side > 0) triangles.push(p, q, r, p, r, s);
          else triangles.push(p, r, q, p, s, r);
        }
      }
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('normal', new BufferAttribute(new Float32Array(normals), 3));
  geometry.setIndex(triangles);
  return geometry;
}
