// The page's data, unpacked: what view.json holds (see src/output/view.h).

export interface WallData { name: string; vertices: Float32Array; triangles: Uint32Array }
export interface MarkData { name: string; kind: string; low: number[]; high: number[] }
export interface RockData {
  count: number; x: Float32Array; q: Float32Array; semiAxes: Float32Array;
  blockiness: Float32Array; speed: Float32Array; wetted: Float32Array;
}
export interface WaterData { count: number; x: Float32Array; speed: Float32Array; pointRadius: number }
export interface SceneData {
  up: number[]; fastest: number;
  walls: WallData[]; marks: MarkData[]; rocks: RockData | null; water: WaterData | null;
}

function bytes(base64: string): ArrayBuffer {
  const text = atob(base64);
  const out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) out[i] = text.charCodeAt(i);
  return out.buffer;
}
const floats = (text: string) => new Float32Array(bytes(text));

/** The JSON of a <script type="application/json">; null where the page has none. */
export function pageJson(id: string): any {
  const element = document.getElementById(id);
  return element ? JSON.parse(element.textContent ?? 'null') : null;
}

export function readScene(json: any, fastest: number): SceneData {
  return {
    up: json.up,
    fastest,
    walls: json.walls.map((w: any) => ({
      name: w.name, vertices: floats(w.vertices), triangles: new Uint32Array(bytes(w.triangles)),
    })),
    marks: json.marks,
    rocks: json.rocks && {
      count: json.rocks.count, x: floats(json.rocks.x), q: floats(json.rocks.q),
      semiAxes: floats(json.rocks.semi_axes), blockiness: floats(json.rocks.blockiness),
      speed: floats(json.rocks.speed), wetted: floats(json.rocks.wetted),
    },
    water: json.water && {
      count: json.water.count, x: floats(json.water.x), speed: floats(json.water.speed),
      pointRadius: json.water.point_radius,
    },
  };
}
