// How luminances and z are spread.

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
