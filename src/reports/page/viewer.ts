// What moves on a run's page. The page itself is written by src/reports/run_page.cpp and can be read
// without this script.
import './page.css';
import { pageJson, readScene } from './scene_data';
import { RockColour, SceneView } from './scene_view';
import { drawTimeCharts } from './time_charts';

function checkbox(label: string, checked: boolean, change: (on: boolean) => void): HTMLElement {
  const row = document.createElement('label');
  const box = document.createElement('input');
  box.type = 'checkbox';
  box.checked = checked;
  box.addEventListener('change', () => change(box.checked));
  row.append(box, document.createTextNode(' ' + label));
  return row;
}

function heading(text: string): HTMLElement {
  const h = document.createElement('h4');
  h.textContent = text;
  return h;
}

function buildControls(panel: HTMLElement, view: SceneView, hasRocks: boolean, hasWater: boolean): void {
  const looks = document.createElement('div');
  looks.className = 'buttons';
  for (const [label, from] of [['Overview', 'overview'], ['Side', 'side'], ['Exit', 'exit'], ['Top', 'top']] as const) {
    const button = document.createElement('button');
    button.textContent = label;
    button.addEventListener('click', () => view.look(from));
    looks.append(button);
  }
  panel.append(heading('Look from'), looks, heading('Show'));
  const toggle = (label: string, group: { visible: boolean }) =>
    checkbox(label, true, (on) => { group.visible = on; view.draw(); });
  if (hasRocks) panel.append(toggle('rocks', view.rocks));
  if (hasWater) panel.append(toggle('water', view.water));
  if (view.marks.children.length > 0) panel.append(toggle('exits and emitters', view.marks));
  if (hasRocks) {
    const select = document.createElement('select');
    for (const by of hasWater ? ['stone', 'speed', 'wetted'] : ['speed', 'stone']) {
      const option = document.createElement('option');
      option.value = by;
      option.textContent = by === 'wetted' ? 'wetted fraction' : by;
      select.append(option);
    }
    select.addEventListener('change', () => view.colourRocks(select.value as RockColour));
    panel.append(heading('Colour of rocks'), select);
  }
  const slider = document.createElement('input');
  slider.type = 'range';
  slider.min = '0';
  slider.max = '1';
  slider.step = '0.02';
  slider.value = '0.18';
  slider.addEventListener('input', () => view.wallOpacity(Number(slider.value)));
  panel.append(heading('Walls'), slider);
  const list = document.createElement('div');
  list.className = 'walls';
  for (const [name, group] of view.walls) list.append(toggle(name, group));
  panel.append(list);
}

function start(): void {
  const root = document.documentElement;
  root.dataset.charts = String(drawTimeCharts());
  const host = document.getElementById('scene');
  const json = pageJson('view-data');
  if (host && json) {
    try {
      const data = readScene(json, Number(host.dataset.fastest));
      const view = new SceneView(host, data);
      const panel = document.getElementById('scene-controls');
      if (panel) buildControls(panel, view, data.rocks !== null, data.water !== null);
      root.dataset.rocks = String(data.rocks?.count ?? 0);
      root.dataset.water = String(data.water?.count ?? 0);
      root.dataset.walls = String(data.walls.length);
    } catch (error) {
      host.textContent = 'The 3D view needs WebGL, which this browser does not offer: ' + String(error);
      root.dataset.viewer = 'failed';
      return;
    }
  }
  root.dataset.viewer = 'ready';
}

start();
