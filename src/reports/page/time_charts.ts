// Time series that can be zoomed: uPlot takes the place of each static chart.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { pageJson } from './scene_data';

const colours = ['#1156a4', '#c4601d', '#12876f', '#8c3f8c', '#8a7500', '#5a6672', '#b3243f'];

interface ChartData { id: string; label: string; names: string[]; values: (number | null)[][] }

export function drawTimeCharts(): number {
  const series: { time: number[]; charts: ChartData[] } | null = pageJson('series-data');
  if (!series) return 0;
  const sync = uPlot.sync('time');
  for (const chart of series.charts) {
    const host = document.getElementById(chart.id);
    if (!host) continue;
    const width = () => Math.max(280, host.clientWidth);
    host.replaceChildren();
    const plot = new uPlot({
      width: width(),
      height: 250,
      cursor: { sync: { key: sync.key } },
      scales: { x: { time: false } },
      axes: [
        { label: 'time, s', labelSize: 22, font: '11px system-ui', labelFont: '12px system-ui' },
        { label: chart.label, labelSize: 22, size: 62, font: '11px system-ui', labelFont: '12px system-ui' },
      ],
      series: [
        { label: 'time, s', value: (_: uPlot, v: number | null) => (v === null ? '\u2013' : v.toPrecision(4)) },
        ...chart.names.map((name, k) => ({
          label: name, stroke: colours[k % colours.length], width: 1.6, points: { show: false },
          value: (_: uPlot, v: number | null) => (v === null ? '\u2013' : v.toPrecision(4)),
        })),
      ],
    }, [series.time, ...chart.values] as uPlot.AlignedData, host);
    new ResizeObserver(() => plot.setSize({ width: width(), height: 250 })).observe(host);
  }
  return series.charts.length;
}
