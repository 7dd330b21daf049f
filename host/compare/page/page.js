"use strict";
// The page of a comparison: pictures from float values, all views linked, and tables. Positions are in
// pixels of the picture; `view.scale` is the number of pixels of the page that one of them takes.

const byId = (id) => document.getElementById(id);
const comparison = JSON.parse(byId("comparison").textContent);
const planes = JSON.parse(byId("planes").textContent);
const { width, height } = comparison;
const pixels = width * height;
const MIN_SCALE = 1 / 64, MAX_SCALE = 256;
const NUMBERS_FROM_SCALE = 64;  // a pixel's values are written into it
const Z_RANGE = 5;
const NOT_FINITE = [255, 0, 255];

// ---- Values

/// Floats whose bytes of equal weight lie together, packed with zlib, in base64.
async function unpack(base64) {
    const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    const apart = new Uint8Array(await new Response(stream).arrayBuffer());
    const count = apart.length / 4;
    const bytes = new Uint8Array(apart.length);
    for (let byte = 0; byte < 4; byte++) {
        for (let i = 0; i < count; i++) bytes[4 * i + byte] = apart[byte * count + i];
    }
    return new Float32Array(bytes.buffer);
}

const luminance = (rgb, i) => 0.2126 * rgb[3 * i] + 0.7152 * rgb[3 * i + 1] + 0.0722 * rgb[3 * i + 2];
const srgb = (v) => 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * Math.pow(v, 1 / 2.4) - 0.055);
const clamp = (v, lo, hi) => Math.min(hi, Math.max(lo, v));

/// Up to `digits` digits, without zeros at the end.
function short(value, digits = 6) {
    if (value === null || value === undefined) return "–";
    if (typeof value !== "number" || !isFinite(value)) return String(value);
    return String(Number(value.toPrecision(digits)));
}
const percent = (value, digits = 3) => (value === null ? "–" : `${short(100 * value, digits)} %`);

// ---- Views

/// White at 0, red above, blue below; `t` in [-1, 1].
function diverging(t) {
    const fade = 255 * (1 - Math.min(1, Math.abs(t)));
    return t >= 0 ? [255 - 55 * Math.max(0, t - 0.5) * 2, fade, fade] : [fade, fade, 255 - 55 * Math.max(0, -t - 0.5) * 2];
}
const viridisAt = (t) => {
    const i = 3 * Math.round(255 * clamp(t, 0, 1));
    return [viridis[i], viridis[i + 1], viridis[i + 2]];
};

let A, B, flip, z, viridis;
let views = [];
let view = { shown: 0, before: 1, sideBySide: false, scale: 1, x: width / 2, y: height / 2, exposure: 0, range: 0 };
let fitted = true;  // the picture follows the size of the window

function pictureColor(rgb, i) {
    const factor = Math.pow(2, view.exposure);
    const color = [0, 1, 2].map((c) => factor * rgb[3 * i + c]);
    return color.every(isFinite) ? color.map((v) => srgb(clamp(v, 0, 1))) : NOT_FINITE;
}
const rgbText = (rgb, i) => [0, 1, 2].map((c) => short(rgb[3 * i + c], 5));
const errorRange = () => Math.pow(2, view.range);

function makeViews() {
    views = [
        { name: "A", title: `A  ${comparison.a.file}`, color: (i) => pictureColor(A, i), text: (i) => rgbText(A, i) },
        { name: "B", title: `B  ${comparison.b.file}`, color: (i) => pictureColor(B, i), text: (i) => rgbText(B, i) },
        {
            name: "A − B", title: "A − B, luminance",
            color: (i) => {
                const error = luminance(A, i) - luminance(B, i);
                return isFinite(error) ? diverging(error / errorRange()) : NOT_FINITE;
            },
            text: (i) => [short(luminance(A, i) - luminance(B, i), 4)],
            scale: () => ["diverging", short(-errorRange(), 3), short(errorRange(), 3)],
        },
        {
            name: "FLIP", title: comparison.metrics.hdrFlip ? "HDR-FLIP" : "LDR-FLIP",
            color: (i) => (isFinite(flip[i]) ? viridisAt(flip[i]) : NOT_FINITE),
            text: (i) => [short(flip[i], 4)],
            scale: () => ["viridis", "0", "1"],
        },
    ];
    if (z) {
        views.push({
            name: "z", title: "z: A − B in standard errors; grey: no evidence",
            color: (i) => (isFinite(z[i]) ? diverging(z[i] / Z_RANGE) : [96, 96, 96]),
            text: (i) => [short(z[i], 4)],
            scale: () => ["diverging", `−${Z_RANGE}`, `+${Z_RANGE}`],
        });
    }
}

function gradient(kind) {
    const at = kind === "viridis" ? viridisAt : (t) => diverging(2 * t - 1);
    const stops = Array.from({ length: 17 }, (_, i) => `rgb(${at(i / 16).map(Math.round).join()})`);
    return `linear-gradient(90deg, ${stops.join()})`;
}

// ---- Drawing

/// The picture of a view at one pixel a value.
function paint(shown) {
    if (!shown.picture) {
        shown.picture = document.createElement("canvas");
        shown.picture.width = width;
        shown.picture.height = height;
    }
    const context = shown.picture.getContext("2d");
    const image = context.createImageData(width, height);
    for (let i = 0; i < pixels; i++) {
        const color = shown.color(i);
        for (let c = 0; c < 3; c++) image.data[4 * i + c] = color[c];
        image.data[4 * i + 3] = 255;
    }
    context.putImageData(image, 0, 0);
    shown.stale = false;
}

function drawNumbers(context, shown, corner, size) {
    const { scale } = view;
    context.font = `${Math.min(13, scale / 7)}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    const [left, top] = corner.map((v) => Math.max(0, Math.floor(v)));
    for (let y = top; y < Math.min(height, corner[1] + size[1] / scale); y++) {
        for (let x = left; x < Math.min(width, corner[0] + size[0] / scale); x++) {
            const i = y * width + x;
            const [r, g, b] = shown.color(i);
            context.fillStyle = 0.3 * r + 0.6 * g + 0.1 * b > 128 ? "#000" : "#fff";
            const lines = shown.text(i);
            lines.forEach((line, n) => {
                const down = 0.5 + (n - (lines.length - 1) / 2) * 0.22;
                context.fillText(line, (x - corner[0] + 0.5) * scale, (y - corner[1] + down) * scale);
            });
        }
    }
}

function drawPane(shown) {
    const { canvas } = shown;
    const size = [canvas.clientWidth, canvas.clientHeight];
    if (size[0] === 0) return;
    const density = window.devicePixelRatio || 1;
    canvas.width = Math.round(size[0] * density);
    canvas.height = Math.round(size[1] * density);
    if (shown.stale !== false) paint(shown);
    const corner = [view.x - size[0] / 2 / view.scale, view.y - size[1] / 2 / view.scale];
    const context = canvas.getContext("2d");
    context.setTransform(density, 0, 0, density, 0, 0);
    context.imageSmoothingEnabled = view.scale < 1;
    context.drawImage(shown.picture, -corner[0] * view.scale, -corner[1] * view.scale, width * view.scale, height * view.scale);
    if (view.scale >= NUMBERS_FROM_SCALE) drawNumbers(context, shown, corner, size);
}

function draw() {
    views.forEach((shown, i) => {
        const visible = view.sideBySide || i === view.shown;
        shown.pane.hidden = !visible;
        shown.button.setAttribute("aria-pressed", String(i === view.shown));
        if (shown.scale) {
            const [kind, low, high] = shown.scale();
            shown.legend.replaceChildren(low, Object.assign(document.createElement("i"), { style: `background: ${gradient(kind)}` }), high);
        }
    });
    const columns = !view.sideBySide ? 1 : Math.ceil(views.length / (byId("panes").clientWidth > 900 ? 2 : 3));
    byId("panes").style.gridTemplateColumns = `repeat(${columns}, minmax(0, 1fr))`;
    byId("layout").setAttribute("aria-pressed", String(view.sideBySide));
    byId("exposure").value = view.exposure;
    byId("exposureText").textContent = `${view.exposure >= 0 ? "+" : "−"}${Math.abs(view.exposure)} stops`;
    byId("range").value = view.range;
    byId("rangeText").textContent = short(errorRange(), 3);
    if (fitted) {
        const { canvas } = views[view.shown];
        view.scale = Math.min(canvas.clientWidth / width, canvas.clientHeight / height);
        if (view.scale > 1) view.scale = Math.floor(view.scale);
        [view.x, view.y] = [width / 2, height / 2];
    }
    for (const shown of views) if (!shown.pane.hidden) drawPane(shown);
}

let drawing = false;
function drawSoon() {
    if (drawing) return;
    drawing = true;
    requestAnimationFrame(() => {
        drawing = false;
        draw();
    });
}

// ---- What the user does

function show(index) {
    if (index >= views.length) return;
    if (index !== view.shown) view.before = view.shown;
    view.shown = index;
    drawSoon();
}

/// A and B in turn; from another view back to the one before.
function flipViews() {
    show(view.shown < 2 ? 1 - view.shown : view.before);
}

function zoom(factor, x = view.x, y = view.y) {
    const scale = clamp(view.scale * factor, MIN_SCALE, MAX_SCALE);
    const kept = view.scale / scale;
    view.x = x + (view.x - x) * kept;
    view.y = y + (view.y - y) * kept;
    view.scale = scale;
    fitted = false;
    drawSoon();
}

function pan(dx, dy) {
    view.x = clamp(view.x + dx / view.scale, 0, width);
    view.y = clamp(view.y + dy / view.scale, 0, height);
    fitted = false;
    drawSoon();
}

function fit() {
    fitted = true;
    drawSoon();
}

function setExposure(stops) {
    view.exposure = clamp(stops, -12, 12);
    views[0].stale = views[1].stale = true;
    drawSoon();
}

function setRange(power) {
    view.range = clamp(power, -24, 12);
    views[2].stale = true;
    drawSoon();
}

function toggleLayout() {
    view.sideBySide = !view.sideBySide;
    drawSoon();
}

const showKeys = () => byId("keys").showModal();

const KEYS = [
    [["1", "2", "3", "4", "5"], "A, B, A − B, FLIP, z", (key) => show(Number(key) - 1)],
    [[" "], "Space: A and B in turn, or the view before", flipViews],
    [["s"], "all views side by side", toggleLayout],
    [["+", "=", "-"], "zoom in and out, as the wheel does", (key) => zoom(key === "-" ? 1 / 1.5 : 1.5)],
    [["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"], "move, as dragging does",
        (key) => pan(60 * ((key === "ArrowRight") - (key === "ArrowLeft")), 60 * ((key === "ArrowDown") - (key === "ArrowUp")))],
    [["0"], "the whole picture", fit],
    [["e", "E"], "exposure up, down by half a stop", (key) => setExposure(view.exposure + (key === "e" ? 0.5 : -0.5))],
    [["r", "R"], "smaller, larger errors at the ends of the colours", (key) => setRange(view.range + (key === "r" ? -0.5 : 0.5))],
    [["h", "?"], "these keys", showKeys],
];

document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || byId("keys").open) return;
    if (event.target.tagName === "INPUT" && event.key.startsWith("Arrow")) return;
    if (event.target.tagName === "BUTTON" && event.key === " ") return;
    const entry = KEYS.find(([keys]) => keys.includes(event.key));
    if (!entry) return;
    event.preventDefault();
    entry[2](event.key);
});

function placeOf(event) {
    const box = event.currentTarget.getBoundingClientRect();
    return [
        view.x + (event.clientX - box.left - box.width / 2) / view.scale,
        view.y + (event.clientY - box.top - box.height / 2) / view.scale,
    ];
}

function tellPixel(x, y) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    const i = y * width + x;
    const parts = [`pixel (${x}, ${y})`];
    for (const shown of views) parts.push(`${shown.name}  ${shown.text(i).join(", ")}`);
    byId("pixel").replaceChildren(...parts.map((part) => Object.assign(document.createElement("span"), { textContent: part })));
}

function listen(canvas) {
    canvas.addEventListener("wheel", (event) => {
        event.preventDefault();
        zoom(Math.pow(1.0015, -event.deltaY), ...placeOf(event));
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
        if (event.buttons & 1) pan(-event.movementX, -event.movementY);
        tellPixel(...placeOf(event).map(Math.floor));
    });
}

function makePanes() {
    views.forEach((shown, i) => {
        shown.pane = document.createElement("div");
        shown.pane.className = "pane";
        shown.canvas = document.createElement("canvas");
        const label = Object.assign(document.createElement("div"), { className: "label", textContent: shown.title });
        shown.pane.append(shown.canvas, label);
        if (shown.scale) {
            shown.legend = Object.assign(document.createElement("div"), { className: "scale" });
            shown.pane.append(shown.legend);
        }
        byId("panes").append(shown.pane);
        listen(shown.canvas);
        shown.button = document.createElement("button");
        shown.button.append(Object.assign(document.createElement("kbd"), { textContent: i + 1 }), shown.name);
        shown.button.addEventListener("click", () => show(i));
        byId("views").append(shown.button);
    });
    byId("layout").addEventListener("click", toggleLayout);
    byId("fit").addEventListener("click", fit);
    byId("help").addEventListener("click", showKeys);
    byId("exposure").addEventListener("input", (event) => setExposure(Number(event.target.value)));
    byId("range").addEventListener("input", (event) => setRange(Number(event.target.value)));
    new ResizeObserver(drawSoon).observe(byId("panes"));
    const names = { " ": "Space", ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓" };
    fillTable(document.querySelector("#keys table"), [],
        KEYS.map(([keys, words]) => [keys.map((key) => names[key] || key).join("  "), words.replace("Space: ", "")]));
}

// ---- Histograms

function style(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/// `bins` from `lo` to `hi`; values beyond are not counted.
function countIn(values, lo, hi, bins) {
    const counts = new Float64Array(bins);
    for (const value of values) {
        const bin = Math.floor(((value - lo) / (hi - lo)) * bins);
        if (value === hi) counts[bins - 1]++;
        else if (bin >= 0 && bin < bins) counts[bin]++;
    }
    return counts;
}

/// Curves over one axis. `ticks`: [position, text].
function plot(canvas, lo, hi, curves, ticks) {
    const context = canvas.getContext("2d");
    const [left, right, top, bottom] = [12, 12, 12, 30];
    const w = canvas.width - left - right, h = canvas.height - top - bottom;
    const highest = Math.max(1, ...curves.flatMap((curve) => [...curve.counts]));
    const toX = (v) => left + ((v - lo) / (hi - lo)) * w;
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.font = "14px system-ui, sans-serif";
    context.textAlign = "center";
    for (const [at, text] of ticks) {
        context.fillStyle = style("--line");
        context.fillRect(toX(at), top, 1, h);
        context.fillStyle = style("--soft");
        context.fillText(text, clamp(toX(at), 22, canvas.width - 22), top + h + 20);
    }
    for (const { counts, color, filled } of curves) {
        context.beginPath();
        const step = w / counts.length;
        if (filled) context.moveTo(left, top + h);
        counts.forEach((count, i) => {
            const y = top + h * (1 - count / highest);
            context.lineTo(left + i * step, y);
            context.lineTo(left + (i + 1) * step, y);
        });
        if (filled) context.lineTo(left + w, top + h);
        context.lineWidth = 2;
        context.strokeStyle = context.fillStyle = color;
        context.globalAlpha = filled ? 0.35 : 1;
        if (filled) context.fill();
        else context.stroke();
        context.globalAlpha = 1;
    }
}

function drawLuminances() {
    const logs = [A, B].map((rgb) => {
        const values = [];
        for (let i = 0; i < pixels; i++) {
            const value = luminance(rgb, i);
            if (value > 0 && isFinite(value)) values.push(Math.log10(value));
        }
        return values.sort((p, q) => p - q);
    });
    // All but the outermost thousandth: a few pixels that are nearly black would take half of the axis.
    const ends = logs.filter((values) => values.length > 0).map((values) => [values[Math.floor(values.length / 1000)], values[values.length - 1]]);
    const lo = Math.floor(10 * Math.min(...ends.map((end) => end[0]), 0)) / 10;
    const hi = Math.ceil(10 * Math.max(...ends.map((end) => end[1]), lo + 0.1)) / 10;
    const ticks = [];
    for (let power = Math.ceil(lo); power <= hi; power++) ticks.push([power, short(Math.pow(10, power))]);
    plot(byId("luminanceHistogram"), lo, hi, [
        { counts: countIn(logs[0], lo, hi, 128), color: style("--a") },
        { counts: countIn(logs[1], lo, hi, 128), color: style("--b") },
    ], ticks);
    const dark = logs.map((values, i) => pixels - values.length + values.findIndex((v) => v >= lo) * (values.length > 0));
    byId("dark").textContent = dark.some((n) => n > 0) ? `Not shown, black or darker: ${dark[0]} pixels of A, ${dark[1]} of B.` : "";
}

function drawZ() {
    byId("zFigure").hidden = !z;
    if (!z) return;
    const values = z.filter(isFinite);
    const bins = 100, counts = countIn(values, -Z_RANGE, Z_RANGE, bins);
    const step = (2 * Z_RANGE) / bins;
    const expected = counts.map((_, i) => {
        const at = -Z_RANGE + (i + 0.5) * step;
        return (values.length * step * Math.exp(-0.5 * at * at)) / Math.sqrt(2 * Math.PI);
    });
    const ticks = Array.from({ length: 11 }, (_, i) => [i - 5, String(i - 5)]);
    plot(byId("zHistogram"), -Z_RANGE, Z_RANGE,
        [{ counts, color: style("--b"), filled: true }, { counts: expected, color: style("--ink") }], ticks);
    const beyond = values.length - counts.reduce((sum, count) => sum + count, 0);
    byId("beyond").textContent = `${values.length} pixels with evidence, ${beyond} of them beyond ±${Z_RANGE}.`;
}

// ---- Words

/// Rows of cells; a cell that is an array is [class, text].
function fillTable(table, head, rows) {
    const row = (cells, tag) => {
        const line = document.createElement("tr");
        cells.forEach((cell, i) => {
            const [kind, text] = Array.isArray(cell) ? cell : ["", cell];
            const element = document.createElement(tag || (i === 0 ? "th" : "td"));
            element.className = kind;
            element.textContent = text;
            line.append(element);
        });
        return line;
    };
    if (head.length > 0) table.createTHead().append(row(head, "th"));
    const body = table.createTBody();
    for (const cells of rows) {
        const line = row(cells);
        if (cells.kind) line.className = cells.kind;
        body.append(line);
    }
}

function tellVerdict() {
    const { a, b, verdict, reason, notes } = comparison;
    byId("title").replaceChildren(
        Object.assign(document.createElement("span"), { className: "a", textContent: a.file }), " against ",
        Object.assign(document.createElement("span"), { className: "b", textContent: b.file }));
    document.title = `${verdict}: ${a.file} against ${b.file}`;
    const words = { same: "same", equivalent: "equivalent", undecided: "undecided", differ: "different" };
    Object.assign(byId("verdict"), { textContent: words[verdict], className: verdict });
    byId("reason").textContent = reason;
    byId("notes").replaceChildren(...notes.map((note) => Object.assign(document.createElement("li"), { textContent: note })));
}

function tellMetrics() {
    const m = comparison.metrics;
    const flipMore = (f) => `weighted median ${short(f.weightedMedian, 4)}, largest ${short(f.largest, 4)}`;
    const defined = [
        ["MAE", m.mae, "mean of |a − b|"],
        ["MSE", m.mse, "mean of (a − b)²"],
        ["RMSE", m.rmse, "square root of MSE"],
        ["relMSE", m.relMse, "mean of (a − b)² / (b² + 0.01)"],
        ["SMAPE", m.smape, "mean of 2 |a − b| / (|a| + |b| + 0.01)"],
        ["PSNR", m.psnr, "[dB] of values as a display shows them, peak 1"],
        ["SSIM", m.ssim, "windows of 11 × 11 pixels, sigma 1.5, luma as a display shows it"],
        ["LDR-FLIP", m.ldrFlip.mean, flipMore(m.ldrFlip)],
    ];
    if (m.hdrFlip) defined.push(["HDR-FLIP", m.hdrFlip.mean, flipMore(m.hdrFlip)]);
    const rows = defined.map(([name, measure, words]) =>
        [name, ["number", short(measure.all)], ["number", short(measure.trimmed)], ["words", words]]);
    const at = m.largestDifference;
    rows.push(["Largest |a − b|", ["number", short(at.value)], "", ["words", `at pixel (${at.x}, ${at.y})`]]);
    rows.push(["Pixels", ["number", String(m.pixels)], "", ["words", `${m.differingPixels} differ in some bit; ${m.excludedPixels} more are not finite and left out`]]);
    for (const [who, picture] of [["A", comparison.a], ["B", comparison.b]]) {
        const odd = Object.entries(picture.counts).map(([channel, n]) => `${channel}: ${n.nan} NaN, ${n.infinite} infinite, ${n.negative} negative`);
        rows.push([`Values of ${who}`, "", "", ["words", odd.join("; ")]]);
    }
    fillTable(byId("metrics"), ["", "all", "without the worst 0.1 %", ""], rows);
}

function tellNoise() {
    const { statistics: s, paired } = comparison;
    byId("noiseSection").hidden = !s && !paired;
    if (paired) {
        fillTable(byId("noise"), [], [
            ["A − B", percent(paired.mean), ["words", "of the mean luminance; both share random numbers, so this is no test"]],
            ["Spread of it", percent(paired.spread), ["words", "one standard error, from the spread between blocks of 8 × 8 pixels"]],
            ["Largest block", percent(paired.largestBlock), ["words", "of the mean luminance"]],
        ]);
    }
    if (!s) return;
    const mean = Math.abs(s.meanA + s.meanB) / 2;
    fillTable(byId("noise"), [], [
        ["Mean luminance", `A ${short(s.meanA)}, B ${short(s.meanB)}`, ""],
        ["A − B", `${percent(s.frame.difference / mean)} ± ${percent(s.frame.standardError / mean)}`, ["words", `of the mean, one standard error; z ${short(s.frame.z, 3)}, p ${short(s.frame.p, 3)}`]],
        ["Blocks that differ", `${s.differingBlocks.length} of ${s.testedBlocks}`, ["words", `8 × 8 pixels each; of ${s.blocks}, the others have no spread`]],
        ["Detectable bias", percent(s.detectableBias), ["words", `of the mean, in the frame; ${percent(s.detectableBlock)} in the middle block: found in 4 of 5 cases`]],
        ["Equal within", percent(s.confidenceBound), ["words", `95 % sure; ${s.equivalent ? "below" : "not below"} the margin of ${percent(s.margin)}`]],
        ["Chance of a false alarm", percent(s.level), ["words", "frame and all blocks together"]],
        ["Pixels without evidence", String(s.noEvidencePixels), ["words", `variance 0 in both files; ${s.noEvidenceDiffering} of them differ`]],
    ]);
}

function tellGates() {
    byId("gatesSection").hidden = comparison.gates.length === 0;
    fillTable(byId("gates"), [], comparison.gates.map(({ gate, state, finding }) => [gate, [state, state], finding]));
}

function tellMetadata() {
    const { a, b } = comparison;
    const names = [...new Set([...Object.keys(a.metadata), ...Object.keys(b.metadata)])].sort();
    const rows = [["Format", a.format, b.format]].concat(names.map((name) => [name, a.metadata[name] ?? "–", b.metadata[name] ?? "–"]));
    for (const row of rows) if (row[1] !== row[2]) row.kind = "other";
    fillTable(byId("metadata"), ["", "A", "B"], rows);
}

/// Power of two such that 1 pixel of 100 has a larger error.
function startRange() {
    const errors = [];
    for (let i = 0; i < pixels; i++) {
        const error = Math.abs(luminance(A, i) - luminance(B, i));
        if (isFinite(error) && error > 0) errors.push(error);
    }
    if (errors.length === 0) return -10;
    errors.sort((p, q) => p - q);
    return clamp(Math.round(4 * Math.log2(errors[Math.floor(0.99 * errors.length)])) / 4, -24, 12);
}

async function start() {
    tellVerdict();
    tellMetrics();
    tellNoise();
    tellGates();
    tellMetadata();
    [A, B, flip] = await Promise.all([planes.a, planes.b, planes.flip].map(unpack));
    z = planes.z ? await unpack(planes.z) : null;
    viridis = Uint8Array.from(atob(planes.viridis), (c) => c.charCodeAt(0));
    makeViews();
    makePanes();
    view.range = startRange();
    draw();
    drawLuminances();
    drawZ();
    document.body.dataset.ready = "yes";
}

start();
