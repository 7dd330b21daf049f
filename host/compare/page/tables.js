// What was measured, in words.

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
