// The 3D view of the last state: rocks as instanced superquadrics, water as shaded points, walls as glass.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { speedColour, stoneColour } from './colours';
import { SceneData } from './scene_data';
import { superquadricGeometry } from './superquadric';

export type RockColour = 'stone' | 'speed' | 'wetted';

export class SceneView {
  readonly walls = new Map<string, THREE.Group>();
  readonly rocks = new THREE.Group();
  readonly water = new THREE.Group();
  readonly marks = new THREE.Group();
  private readonly scene = new THREE.Scene();
  private readonly renderer: THREE.WebGLRenderer;
  private readonly camera: THREE.PerspectiveCamera;
  private readonly controls: OrbitControls;
  private readonly bounds = new THREE.Box3();
  private readonly up: THREE.Vector3;
  private readonly meshes: { mesh: THREE.InstancedMesh; indices: number[] }[] = [];
  private waiting = false;

  constructor(private readonly host: HTMLElement, private readonly data: SceneData) {
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setClearColor(0xeaeff3);
    host.prepend(this.renderer.domElement);
    this.up = new THREE.Vector3(...(data.up as [number, number, number]));
    this.camera = new THREE.PerspectiveCamera(30, 1, 0.01, 1000);
    this.camera.up.copy(this.up);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener('change', () => this.draw());

    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x98a0a8, 1.5), this.rocks, this.water, this.marks);
    const key = new THREE.DirectionalLight(0xffffff, 2.0);
    key.position.set(-0.6, 0.9, 0.8);
    this.camera.add(key);
    this.scene.add(this.camera);

    this.addWalls();
    this.addRocks();
    this.addWater();
    this.addMarks();
    if (this.bounds.isEmpty()) this.bounds.set(new THREE.Vector3(-0.5, -0.5, -0.5), new THREE.Vector3(0.5, 0.5, 0.5));
    new ResizeObserver(() => this.resize()).observe(host);
    this.resize();
    this.look('overview');
  }

  /** Draws once, before the next repaint. */
  draw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.renderer.render(this.scene, this.camera);
    });
  }

  look(from: 'overview' | 'side' | 'exit' | 'top'): void {
    const { along, across } = this.directions();
    const away = new THREE.Vector3();
    if (from === 'overview') away.addScaledVector(along, 0.75).addScaledVector(across, -0.85).addScaledVector(this.up, 0.5);
    if (from === 'side') away.addScaledVector(across, -1);
    if (from === 'exit') away.addScaledVector(along, 1).addScaledVector(this.up, 0.28);
    if (from === 'top') away.addScaledVector(this.up, 1).addScaledVector(along, 0.001);
    const centre = this.bounds.getCenter(new THREE.Vector3());
    const radius = 0.5 * this.bounds.getSize(new THREE.Vector3()).length();
    const distance = radius / Math.sin(THREE.MathUtils.degToRad(15)) * Math.max(0.95, 1 / this.camera.aspect);
    this.camera.position.copy(centre).addScaledVector(away.normalize(), distance);
    this.camera.near = distance / 200;
    this.camera.far = distance * 10;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(centre);
    this.controls.update();
    this.draw();
  }

  colourRocks(by: RockColour): void {
    const rocks = this.data.rocks;
    if (!rocks) return;
    const colour = new THREE.Color(), dry = new THREE.Color(0xc9a66b), wet = new THREE.Color(0x1f5f8b);
    for (const { mesh, indices } of this.meshes) {
      indices.forEach((i, k) => {
        if (by === 'speed') speedColour(rocks.speed[i] / this.data.fastest, colour);
        else if (by === 'wetted') colour.copy(dry).lerp(wet, rocks.wetted[i]);
        else stoneColour(i, colour);
        mesh.setColorAt(k, colour);
      });
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
    this.draw();
  }

  wallOpacity(opacity: number): void {
    for (const group of this.walls.values())
      group.traverse((part) => {
        if (part instanceof THREE.Mesh) {
          part.material.opacity = opacity;
          part.material.transparent = opacity < 1;
          part.material.depthWrite = opacity >= 1;
          part.material.needsUpdate = true;
        }
      });
    this.draw();
  }

  private addWalls(): void {
    for (const wall of this.data.walls) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(wall.vertices, 3));
      geometry.setIndex(new THREE.BufferAttribute(wall.triangles, 1));
      geometry.computeBoundingBox();
      if (geometry.boundingBox && wall.vertices.length > 0) this.bounds.union(geometry.boundingBox);
      const material = new THREE.MeshLambertMaterial({
        color: 0x7f93a6, side: THREE.DoubleSide, transparent: true, opacity: 0.18, depthWrite: false, flatShading: true,
      });
      const edges = new THREE.LineSegments(
        new THREE.EdgesGeometry(geometry, 20),
        new THREE.LineBasicMaterial({ color: 0x33465a, transparent: true, opacity: 0.6 }));
      const group = new THREE.Group();
      const mesh = new THREE.Mesh(geometry, material);
      mesh.renderOrder = 2;  // glass after what is seen through it
      edges.renderOrder = 3;
      group.add(mesh, edges);
      this.walls.set(wall.name, group);
      this.scene.add(group);
    }
  }

  private addRocks(): void {
    const rocks = this.data.rocks;
    if (!rocks) return;
    const classes = new Map<number, number[]>();  // blockiness -> rocks
    for (let i = 0; i < rocks.count; ++i) {
      const m = Math.round(rocks.blockiness[i] * 100) / 100;
      const list = classes.get(m);
      if (list) list.push(i);
      else classes.set(m, [i]);
    }
    const divisions = rocks.count > 20000 ? 3 : rocks.count > 4000 ? 5 : 8;
    const x = new THREE.Vector3(), q = new THREE.Quaternion(), scale = new THREE.Vector3(), matrix = new THREE.Matrix4();
    for (const [m, indices] of classes) {
      const material = new THREE.MeshLambertMaterial({ color: 0xffffff });
      const mesh = new THREE.InstancedMesh(superquadricGeometry(m, divisions), material, indices.length);
      indices.forEach((i, k) => {
        x.fromArray(rocks.x, 3 * i);
        q.set(rocks.q[4 * i + 1], rocks.q[4 * i + 2], rocks.q[4 * i + 3], rocks.q[4 * i]);
        scale.fromArray(rocks.semiAxes, 3 * i);
        mesh.setMatrixAt(k, matrix.compose(x, q, scale));
        if (this.data.walls.length === 0) this.bounds.expandByPoint(x);
      });
      mesh.frustumCulled = false;
      this.rocks.add(mesh);
      this.meshes.push({ mesh, indices });
    }
    this.colourRocks(this.data.water ? 'stone' : 'speed');
  }

  private addWater(): void {
    const water = this.data.water;
    if (!water || water.count === 0) return;
    const colours = new Float32Array(3 * water.count);
    const colour = new THREE.Color(), x = new THREE.Vector3();
    for (let i = 0; i < water.count; ++i) {
      speedColour(water.speed[i] / this.data.fastest, colour).convertLinearToSRGB().toArray(colours, 3 * i);
      if (this.data.walls.length === 0) this.bounds.expandByPoint(x.fromArray(water.x, 3 * i));
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(water.x, 3));
    geometry.setAttribute('tint', new THREE.BufferAttribute(colours, 3));
    // every point a shaded ball that faces the eye
    const material = new THREE.ShaderMaterial({
      uniforms: { radius: { value: 1.25 * water.pointRadius }, height: { value: 1 } },
      vertexShader: `uniform float radius, height; attribute vec3 tint; varying vec3 shown;
        void main() {
          vec4 p = modelViewMatrix * vec4(position, 1.0);
          gl_Position = projectionMatrix * p;
          gl_PointSize = max(1.5, radius * height * projectionMatrix[1][1] / gl_Position.w);
          shown = tint;
        }`,
      fragmentShader: `varying vec3 shown;
        void main() {
          vec2 d = 2.0 * gl_PointCoord - 1.0;
          float inside = 1.0 - dot(d, d);
          if (inside < 0.0) discard;
          vec3 n = vec3(d.x, -d.y, sqrt(inside));
          float light = 0.55 + 0.5 * max(0.0, dot(n, normalize(vec3(-0.6, 0.9, 0.8))));
          gl_FragColor = vec4(shown * light, 1.0);
        }`,
    });
    const points = new THREE.Points(geometry, material);
    points.frustumCulled = false;
    points.onBeforeRender = () => {
      material.uniforms.height.value = this.renderer.getDrawingBufferSize(new THREE.Vector2()).y;
    };
    this.water.add(points);
  }

  private addMarks(): void {
    const colours: Record<string, number> = { exit: 0xc4601d, feed: 0x6b4f2a, jet: 0x1156a4 };
    for (const mark of this.data.marks) {
      const box = new THREE.Box3(new THREE.Vector3(...(mark.low as [number, number, number])),
                                 new THREE.Vector3(...(mark.high as [number, number, number])));
      this.marks.add(new THREE.Box3Helper(box, colours[mark.kind] ?? 0x5a6672));
    }
  }

  /** As scene_frame() in src/reports/picture.cpp. */
  private directions(): { along: THREE.Vector3; across: THREE.Vector3 } {
    const up = this.up.toArray();
    const vertical = [0, 1, 2].reduce((best, k) => (Math.abs(up[k]) > Math.abs(up[best]) ? k : best), 0);
    const size = this.bounds.getSize(new THREE.Vector3()).toArray();
    const centre = this.bounds.getCenter(new THREE.Vector3()).toArray();
    const first = (vertical + 1) % 3, second = (vertical + 2) % 3;
    let across = size[first] < size[second] ? first : second;
    const exit = this.data.marks.find((m) => m.kind === 'exit');
    let towards = centre;
    if (exit) {
      const extent = exit.high.map((x, k) => x - exit.low[k]);
      if (extent[first] !== extent[second]) across = extent[first] > extent[second] ? first : second;
      towards = exit.low.map((x, k) => (x + exit.high[k]) / 2) as typeof centre;
    }
    const along = across === first ? second : first;
    const a = [0, 0, 0];
    a[along] = towards[along] < centre[along] ? -1 : 1;
    const alongVector = new THREE.Vector3(...(a as [number, number, number]));
    return { along: alongVector, across: this.up.clone().cross(alongVector) };
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
