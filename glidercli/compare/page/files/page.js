"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const root = document.documentElement;
  const PRINTED = 335; // px, half of what paper of either kind leaves between its margins
  const DASHES = ["solid", "dash", "dashdot", "dot"];
  const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif';
  const HOME = { eye: { x: -1.25, y: -1.45, z: 0.75 }, up: { x: 0, y: 0, z: 1 }, center: { x: 0, y: 0, z: -0.08 } };
  const touch = matchMedia("(pointer: coarse)").matches;
  const darkSystem = matchMedia("(prefers-color-scheme: dark)");
  const shown = data.logs.map(() => true);
  const time = { whole: data.range, now: data.range };
  let printing = false;
  let view = structuredClone(HOME);

  const colour = (name) => getComputedStyle(root).getPropertyValue(`--${name}`).trim();
  const logColour = (log) => colour(log.measured ? "measured" : `sim${log.colour % 6}`);
  const plain = (text) => // Plotly reads some markup in texts
    text.replace(/[\u0000-\u001f\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2066-\u2069\ufeff]/g, "\ufffd")
      .replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;").replace(/\$/g, "\uff04");
  const axis = (more) => ({
    gridcolor: colour("grid"), linecolor: colour("line"), zerolinecolor: colour("line"), showline: true, ticks: "outside",
    tickcolor: colour("line"), automargin: true, ...more,
  });
  const base = (width, height) => ({
    width, height, showlegend: false, paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    font: { family: FONT, size: printing ? 9 : 12, color: colour("text") }, hovermode: "closest",
    hoverlabel: { bgcolor: colour("card"), bordercolor: colour("line"), font: { color: colour("text"), family: FONT } },
    margin: { l: printing ? 44 : 58, r: 10, t: 8, b: printing ? 32 : 42 }, dragmode: touch ? false : "zoom", uirevision: "kept",
  });
  const options = { displayModeBar: false, scrollZoom: false, showTips: false, doubleClick: false, displaylogo: false };

  function curve(line, unit, more) {
    const log = data.logs[line.log];
    return {
      x: line.x, y: line.y, type: "scatter", mode: line.dots ? "lines+markers" : "lines", connectgaps: false,
      name: plain(log.short), visible: shown[line.log], marker: { size: 4 },
      line: { color: logColour(log), width: log.measured ? 2.2 : 1.6, dash: log.measured ? "solid" : DASHES[log.colour % 4] },
      hovertemplate: `%{y:.5g} ${unit}<br>%{x} ${data.unit}<extra>%{fullData.name}</extra>`, ...more,
    };
  }

  function panel(one, width) {
    const beneath = one.errors.length > 0;
    const unit = one.unit.split(",")[0];
    const traces = one.lines.map((line) => curve(line, unit, {}));
    one.errors.forEach((line) => {
      const less = curve(line, unit, { yaxis: "y2" });
      less.line.width = 1.3;
      less.name += ` less ${data.logs[0].short}`;
      traces.push(less);
    });
    one.events.forEach((marks) => {
      const log = data.logs[marks.log];
      traces.push({
        x: marks.x, y: marks.y, text: marks.names.map(plain), type: "scatter", mode: "markers", visible: shown[marks.log],
        name: plain(log.short), hovertemplate: "%{text}<br>%{y:.5g} m, %{x} " + data.unit + "<extra>%{fullData.name}</extra>",
        marker: { symbol: log.measured ? "circle-open" : "diamond-open", size: 8, color: logColour(log), line: { width: 1.6 } },
      });
    });
    const shapes = data.legs.filter((leg) => leg.name === "dive").map((leg) => ({
      type: "rect", xref: "x", yref: "paper", x0: leg.begin, x1: leg.end, y0: 0, y1: 1, line: { width: 0 },
      fillcolor: colour("dive"), layer: "below",
    }));
    one.bands.forEach((band) => {
      const middle = (band.low + band.high) / 2;
      const mark = { type: "scatter", name: "published", hovertemplate: `${plain(band.fact)}<extra>published</extra>` };
      if (band.kind === "point") {
        traces.unshift({
          ...mark, x: [band.end], y: [middle], mode: "markers", marker: { color: colour("bandline"), size: 8 },
          error_y: { type: "constant", value: (band.high - band.low) / 2, color: colour("bandline"), thickness: 2, width: 5 },
        });
        return;
      }
      const all = band.kind === "time";
      shapes.push({
        type: "rect", xref: "x", yref: all ? "paper" : "y", x0: band.begin, x1: band.end, y0: all ? 0 : band.low,
        y1: all ? 1 : band.high, line: { width: 0 }, fillcolor: colour("band"), layer: "below",
      });
      if (!all) {
        traces.unshift({
          ...mark, x: [band.begin, (band.begin + band.end) / 2, band.end], y: [middle, middle, middle], mode: "lines",
          line: { color: colour("bandline"), width: 1 },
        });
      }
    });
    const range = time.now ? { range: [...time.now], autorange: false } : { autorange: true };
    const layout = {
      ...base(width, printing ? 205 : beneath ? 330 : 270), shapes,
      xaxis: axis({ ...range, anchor: beneath ? "y2" : "y", title: { text: `time, ${data.unit}`, standoff: 6 }, hoverformat: "~g" }),
      yaxis: axis({
        title: { text: plain(one.unit), standoff: 6 }, domain: beneath ? [0.38, 1] : [0, 1], autorange: one.down ? "reversed" : true,
        tickformat: "~g", nticks: 7,
      }),
    };
    layout.xaxis.zeroline = false;
    layout.yaxis.zeroline = false;
    if (beneath) {
      layout.yaxis2 = axis({ title: { text: plain(`error, ${unit}`), standoff: 6 }, domain: [0, 0.31], zeroline: true, nticks: 4, tickformat: "~g" });
      layout.yaxis2.zerolinecolor = colour("soft");
      const sizes = one.errors.flatMap((line) => line.y).filter((v) => v !== null).map(Math.abs);
      const values = one.lines.flatMap((line) => line.y).filter((v) => v !== null);
      const least = 1e-6 * (values.reduce((a, b) => Math.max(a, b)) - values.reduce((a, b) => Math.min(a, b)));
      if (sizes.every((size) => size < least)) layout.yaxis2.range = [-least, least]; // rounding errors are no signal
    }
    return [traces, layout];
  }

  function above(width) {
    const traces = [];
    data.track.lines.forEach((line) => {
      const look = curve({ ...line, x: line.east, y: line.north }, "m", { hovertemplate: "%{x:.6~g} m east, %{y:.6~g} m north<extra>%{fullData.name}</extra>" });
      look.mode = "lines";
      traces.push(look, {
        x: [line.east[0]], y: [line.north[0]], type: "scatter", mode: "markers", visible: look.visible, name: `${look.name} begins`,
        marker: { symbol: "circle-open", size: 10, color: look.line.color, line: { width: 2 } }, hovertemplate: "begins<extra>%{fullData.name}</extra>",
      });
    });
    return [traces, {
      ...base(width, printing ? 300 : width < 480 ? 340 : 420),
      xaxis: axis({ title: { text: "east, m", standoff: 6 }, constrain: "domain", tickformat: "~g" }),
      yaxis: axis({ title: { text: "north, m", standoff: 6 }, scaleanchor: "x", scaleratio: 1, constrain: "domain", tickformat: "~g" }),
    }];
  }

  const farther = (width, height) => Math.max(1, 1.7 * height / width); // all of the scene in a narrow frame

  function track(width) {
    const extents = ["east", "north", "depth"].map((key) => {
      const all = data.track.lines.flatMap((line) => [line[key].reduce((a, b) => Math.min(a, b)), line[key].reduce((a, b) => Math.max(a, b))]);
      return Math.max(Math.max(...all) - Math.min(...all), 1e-3);
    });
    extents[2] *= data.track.exaggeration;
    const most = Math.max(...extents);
    const ratio = extents.map((extent) => Math.max(extent / most, 0.15));
    const size = Math.cbrt(ratio[0] * ratio[1] * ratio[2]);
    const height = printing ? 300 : width < 480 ? 340 : 420;
    const back = farther(width, height);
    const { x, y, z } = view.eye;
    const traces = [];
    data.track.lines.forEach((line) => {
      const log = data.logs[line.log];
      const look = {
        x: line.east, y: line.north, z: line.depth, type: "scatter3d", mode: "lines", name: plain(log.short), visible: shown[line.log],
        line: { color: logColour(log), width: log.measured ? 5 : 4 },
        hovertemplate: "%{x:.6~g} m east, %{y:.6~g} m north<br>%{z:.5~g} m deep<extra>%{fullData.name}</extra>",
      };
      traces.push(look, {
        ...look, x: line.east.slice(0, 1), y: line.north.slice(0, 1), z: line.depth.slice(0, 1), mode: "markers", name: `${look.name} begins`,
        marker: { symbol: "circle-open", size: 6, color: logColour(log) },
      });
    });
    const side = (text, more) => ({
      title: { text, font: { size: 11 } }, gridcolor: colour("line"), color: colour("text"), zerolinecolor: colour("line"), showbackground: false,
      showspikes: false, nticks: 5, tickformat: "~g", tickfont: { size: 10 }, ...more,
    });
    return [traces, {
      ...base(width, height), margin: { l: 0, r: 0, t: 0, b: 0 },
      scene: {
        camera: { ...view, eye: { x: x * back, y: y * back, z: z * back } }, dragmode: touch ? false : "turntable", aspectmode: "manual",
        aspectratio: { x: ratio[0] / size, y: ratio[1] / size, z: ratio[2] / size },
        xaxis: side("east, m", {}), yaxis: side("north, m", {}), zaxis: side("depth, m", { autorange: "reversed" }),
      },
      uirevision: JSON.stringify([view, width]),
    }];
  }

  const charts = data.panels.map((one, number) => ({ place: document.getElementById(`plot-${number}`), make: (width) => panel(one, width), timed: true }));
  if (data.track) {
    charts.push({ place: document.getElementById("plot-above"), make: above });
    charts.push({ place: document.getElementById("plot-track"), make: track, solid: true });
  }

  function draw(chart) {
    const width = printing ? PRINTED : chart.place.clientWidth;
    if (!width) return;
    const [traces, layout] = chart.make(width);
    chart.place.style.height = `${layout.height}px`;
    try {
      Plotly.react(chart.place, traces, layout, options);
    } catch (fault) { // no WebGL: the tracks from above and their extents in words are there
      chart.place.textContent = `This plot cannot be drawn here: ${fault.message}`;
      return;
    }
    if (chart.wired) return;
    chart.wired = true;
    chart.place.querySelector(".plot-container").setAttribute("aria-hidden", "true"); // the label tells it
    chart.place.on("plotly_relayout", (change) => {
      if (chart.timed && change["xaxis.range[0]"] !== undefined) show([change["xaxis.range[0]"], change["xaxis.range[1]"]], chart);
      const camera = change["scene.camera"];
      if (chart.solid && camera) {
        const back = farther(chart.place.clientWidth, chart.place.clientHeight);
        view = { ...camera, eye: { x: camera.eye.x / back, y: camera.eye.y / back, z: camera.eye.z / back } };
      }
    });
    if (chart.timed) chart.place.on("plotly_doubleclick", () => show(time.whole));
  }
  // The page scrolls over every plot: Plotly keeps wheel and finger to itself over a 3-D one.
  charts.forEach((chart) => ["wheel", ...(touch ? ["touchstart", "touchmove"] : [])].forEach((kind) => {
    chart.place.addEventListener(kind, (event) => event.stopPropagation(), { capture: true, passive: true });
  }));
  const drawAll = () => charts.forEach(draw);

  function ends() {
    if (time.now) return time.now;
    const drawn = charts[0].place._fullLayout;
    return drawn ? [...drawn.xaxis.range] : [0, 1];
  }
  function show(range, but) {
    time.now = range;
    const change = range ? { "xaxis.range": [...range], "xaxis.autorange": false } : { "xaxis.autorange": true };
    charts.filter((chart) => chart.timed && chart !== but).forEach((chart) => {
      const layout = chart.place._fullLayout;
      const same = range && layout && layout.xaxis.range[0] === range[0] && layout.xaxis.range[1] === range[1];
      if (layout && !same) Plotly.relayout(chart.place, change);
    });
  }
  const moves = {
    in: ([a, b]) => [a + (b - a) / 4, b - (b - a) / 4], out: ([a, b]) => [a - (b - a) / 2, b + (b - a) / 2],
    back: ([a, b]) => [a - (b - a) / 4, b - (b - a) / 4], on: ([a, b]) => [a + (b - a) / 4, b + (b - a) / 4], all: () => time.whole,
  };
  document.querySelectorAll("[data-time]").forEach((button) => button.addEventListener("click", () => show(moves[button.dataset.time](ends()))));
  document.querySelectorAll("[data-log]").forEach((box) => box.addEventListener("change", () => {
    shown[Number(box.dataset.log)] = box.checked;
    drawAll();
  }));
  function turned(way) {
    const { x, y, z } = view.eye;
    const far = Math.hypot(x, y, z), angle = Math.atan2(y, x), height = Math.asin(z / far);
    const step = Math.PI / 12;
    const at = {
      left: [angle - step, height, far], right: [angle + step, height, far], up: [angle, Math.min(height + step, 1.5), far],
      down: [angle, Math.max(height - step, -1.5), far], in: [angle, height, far / 1.25], out: [angle, height, far * 1.25],
    }[way];
    if (!at) return structuredClone(HOME);
    return { ...view, eye: { x: at[2] * Math.cos(at[1]) * Math.cos(at[0]), y: at[2] * Math.cos(at[1]) * Math.sin(at[0]), z: at[2] * Math.sin(at[1]) } };
  }
  document.querySelectorAll("[data-turn]").forEach((button) => button.addEventListener("click", () => {
    view = turned(button.dataset.turn);
    charts.filter((chart) => chart.solid).forEach(draw);
  }));

  const theme = document.getElementById("theme");
  const dark = () => (root.dataset.theme ? root.dataset.theme === "dark" : darkSystem.matches);
  const name = () => { theme.textContent = dark() ? "Light colours" : "Dark colours"; };
  theme.hidden = false;
  theme.addEventListener("click", () => {
    root.dataset.theme = dark() ? "light" : "dark";
    name();
    drawAll();
  });
  darkSystem.addEventListener("change", () => { name(); drawAll(); });
  name();

  let before = {};
  addEventListener("beforeprint", () => {
    before = { theme: root.dataset.theme, closed: [...document.querySelectorAll("details:not([open])")] };
    root.dataset.theme = "light";
    before.closed.forEach((one) => { one.open = true; });
    printing = true;
    drawAll();
    charts.filter((chart) => chart.solid && chart.place._fullLayout && chart.place._fullLayout.scene._scene).forEach((chart) => {
      const picture = new Image(); // a WebGL canvas may be empty on paper
      picture.alt = "";
      picture.src = chart.place._fullLayout.scene._scene.toImage("png");
      chart.place.append(picture);
      chart.place.classList.add("pictured");
    });
  });
  addEventListener("afterprint", () => {
    if (!printing) return;
    printing = false;
    if (before.theme) root.dataset.theme = before.theme;
    else delete root.dataset.theme;
    before.closed.forEach((one) => { one.open = false; });
    document.querySelectorAll(".pictured").forEach((place) => {
      place.classList.remove("pictured");
      place.querySelectorAll(":scope > img").forEach((picture) => picture.remove());
    });
    requestAnimationFrame(drawAll); // once the page is as wide as its window again
  });
  matchMedia("print").addEventListener("change", (media) => { // where that comes after the frame
    if (!media.matches && !printing) requestAnimationFrame(drawAll);
  });

  drawAll();
  const scratch = document.getElementById("js-plotly-tester"); // where Plotly measures texts
  if (scratch) scratch.setAttribute("aria-hidden", "true");
  let width = innerWidth;
  addEventListener("resize", () => {
    if (innerWidth === width || printing) return;
    width = innerWidth;
    drawAll();
  });
  root.dataset.ready = "yes";
})();
