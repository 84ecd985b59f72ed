// The speed scale of src/reports/colour.cpp: the same stops, so that pictures and 3D view agree.
import { Color } from 'three';

const stops = [
  [0.043, 0.145, 0.400], [0.067, 0.337, 0.643], [0.063, 0.545, 0.737],
  [0.239, 0.729, 0.690], [0.635, 0.867, 0.600], [0.988, 0.957, 0.639],
];

export function speedColour(fraction: number, to: Color): Color {
  const place = Math.min(Math.max(fraction, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(place), stops.length - 2);
  const t = place - k;
  const mix = (c: number) => stops[k][c] * (1 - t) + stops[k + 1][c] * t;
  return to.setRGB(mix(0), mix(1), mix(2), 'srgb');
}

/** Stones of one quarry are not of one grey. */
export function stoneColour(index: number, to: Color): Color {
  const unit = (salt: number) => {
    let h = (Math.imul(index, 2654435761) + salt) >>> 0;
    h = Math.imul(h ^ (h >>> 15), 2246822519) >>> 0;
    return (h >>> 8) / 16777216 - 0.5;
  };
  const grey = 1 + 0.26 * unit(1), warm = 0.06 * unit(77);
  return to.setRGB(0.70 * grey + warm, 0.64 * grey, 0.56 * grey - warm, 'srgb');
}
