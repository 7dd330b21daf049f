"use strict";
// The page of a comparison is one script in parts: views, controls, histograms, tables, start. Here:
// pictures from float values, all views linked. Positions are in
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
