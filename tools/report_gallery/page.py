"""The page: one HTML file with everything in it, pictures, style and script."""

import base64
import html
import pathlib
import struct

from . import table

HERE = pathlib.Path(__file__).resolve().parent


def png_size(data):
    """Width and height of a PNG picture; None when it is none."""
    if len(data) < 24 or data[:8] != b"\x89PNG\r\n\x1a\n":
        return None
    return struct.unpack(">II", data[16:24])


def image(path, words):
    """A picture that a click enlarges, embedded; None when the file is missing or no PNG."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    size = png_size(data)
    if size is None:
        return None
    code = base64.b64encode(data).decode("ascii")
    return (f'<button type="button" aria-label="enlarge"><img width="{size[0]}" height="{size[1]}" '
            f'alt="{html.escape(words, quote=True)}" src="data:image/png;base64,{code}"></button>')


def all_stats(results):
    """The values that legends may name, of the first step that has them."""
    for result in results:
        if "pixels" in result.stats:
            return {key: f"{value:,}" for key, value in result.stats["pixels"].items()}
    return {}


def legend(pane, values):
    if not pane.legend:
        return ""
    colours, low, high = pane.legend
    try:
        low, high = low.format(**values), high.format(**values)
    except KeyError:
        low, high = "least", "most"
    return f'<div class="legend">{html.escape(low)}<i class="{colours}"></i>{html.escape(high)}</div>'


def row(cells):
    odd = " odd" if len(cells) == 3 else ""
    return f'<div class="row{odd}" style="--n: {len(cells)}">{"".join(cells)}</div>'


def why_absent(pane, figure, results):
    """Why a picture is not there: what the step that writes it has to say."""
    for step, result in zip(figure.steps, results):
        if any(word.endswith("@" + pane.file) or word.endswith("=@" + pane.file) for word in step.args):
            if result.skipped:
                return result.skipped
            if result.error:
                return "This picture could not be made; see above."
    return "This picture was not made."


def panes(setting, figure, results):
    folder = setting.out / f"fig{figure.number:02d}"
    values = all_stats(results)
    cells = []
    for pane in figure.panes:
        words = f"Figure {figure.number}: {pane.label}"
        picture = image(folder / pane.file, words)
        if picture is None:
            picture = f'<div class="absent">{html.escape(why_absent(pane, figure, results))}</div>'
        plot = ' class="plot"' if pane.file.endswith("_values.png") else ""
        cells.append(f"<figure{plot}>{picture}<figcaption>{html.escape(pane.label)}"
                     f"{legend(pane, values)}</figcaption></figure>")
    return row(cells) if cells else ""


def references(setting, figure):
    """The report's own pictures of the figure below ours, where they are at hand."""
    if setting.assets is None:
        return ""
    folder = setting.assets / "references" / "pytracer"
    pictures = [pane.reference and image(folder / f"{pane.reference}.png",
                                         f"The report's figure {figure.number}: {pane.label}")
                for pane in figure.panes]
    if not any(pictures):
        return ""
    cells = [f"<figure>{picture}<figcaption>the report&#8217;s</figcaption></figure>" if picture
             else "<span></span>" for picture in pictures]
    return f"<details open><summary>What the report showed</summary>{row(cells)}</details>"


def step_facts(result):
    """Seconds, rays, samples and device of a step, as far as its statistics say."""
    facts = [f"{result.seconds:.1f} s in all"]
    stats = result.stats
    if "counters" in stats:
        counters, seconds = stats["counters"], stats["seconds"]["render"]
        rays = counters["cameraRays"] + counters["indirectRays"] + counters["shadowRays"]
        facts = [f"{result.seconds:.1f} s, {seconds:.1f} s of them rendering", f"{rays:,} rays",
                 f"{counters['cameraRays']:,} samples",
                 f"{rays / max(seconds, 1e-9) / 1e6:.2f} million rays a second"]
    if "device" in stats:
        facts.append(stats["device"]["name"])
    return "".join(f"<span>{html.escape(fact)}</span>" for fact in facts)


def steps(results):
    items = [f'<li class="step"><code>{html.escape(result.command)}</code><p>{step_facts(result)}</p></li>'
             for result in results if result.command]
    return f'<ol class="steps">{"".join(items)}</ol>' if items else ""


def section(setting, figure, results):
    wrong = "".join(f'<div class="error">{html.escape(result.name)}: {html.escape(result.error)}</div>'
                    for result in results if result.error)
    bench = next((result.stats for result in results if "rows" in result.stats), None)
    return (f'<section id="fig{figure.number}"><h2><span>Figure {figure.number}</span>'
            f"{html.escape(figure.title)}</h2><p>{html.escape(figure.caption)}</p>{wrong}"
            f"{table.benchmark(bench) if bench else ''}{panes(setting, figure, results)}"
            f"{references(setting, figure)}{steps(results)}</section>")


def facts(setting, done, seconds):
    all_results = [result for _, results in done for result in results]
    stats = [result.stats for result in all_results if "counters" in result.stats]
    rays = sum(sum(s["counters"][kind] for kind in ("cameraRays", "indirectRays", "shadowRays")) for s in stats)
    samples = sum(s["counters"]["cameraRays"] for s in stats)
    devices = sorted({s["device"]["name"] for s in stats})
    pairs = [("Device", ", ".join(devices) or setting.device),
             ("Driver", ", ".join(sorted({s["device"]["driver"] for s in stats})) or "none"),
             ("Time", f"{int(seconds // 60)} min {int(seconds % 60)} s"),
             ("Rays", f"{rays:,}"), ("Samples", f"{samples:,}"),
             ("Sahl", ", ".join(sorted({s["sahl"] for s in stats})) or "unknown"),
             ("Meshes", "the report's own" if setting.assets else "fetched ones and Sahl's own teapot")]
    if setting.quick:
        pairs.append(("Quick run", "tiny pictures, few samples"))
    return "".join(f"<div><dt>{name}</dt><dd>{html.escape(value)}</dd></div>" for name, value in pairs)


def make_page(setting, done, seconds):
    """The whole page as text. `done`: pairs of a figure and the results of its steps."""
    links = []
    for figure, results in done:
        wrong = ' class="wrong"' if any(result.error for result in results) else ""
        links.append(f'<a href="#fig{figure.number}"{wrong}>{figure.number}</a>')
    sections = "".join(section(setting, figure, results) for figure, results in done)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Sahl: the report's figures</title>
<link rel="icon" href="data:,">
<style>
{(HERE / "page.css").read_text()}</style>
</head>
<body>
<header>
<h1>The report&#8217;s figures, by Sahl</h1>
<p>Sahl grew from a report on pyTracer, a ray tracer written in Python (Valentin Taillandier, 2020). These
are its figures 5 to 21, made anew: each by the commands below it, on the device named here, and with the
same bits on any other. A click enlarges a picture; arrow keys then step through them.</p>
<dl class="facts">{facts(setting, done, seconds)}</dl>
<nav aria-label="figures">{"".join(links)}</nav>
</header>
<main>
{sections}
</main>
<footer>
<p>Made by tools/gallery. Commands run in the source tree; a file in out/gallery/ is made on the way.
Scenes are in scenes/report/, one folder a figure. &#8220;Rays&#8221; are rays of the camera, rays that go on
from a surface, and shadow rays; a sample is one path from the camera.</p>
</footer>
<dialog aria-label="enlarged picture"><form method="dialog"><img alt=""><p></p></form></dialog>
<script>
{(HERE / "page.js").read_text()}</script>
</body>
</html>
"""
