// What the user does: keys, buttons, wheel and pointer.

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
