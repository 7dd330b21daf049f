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
