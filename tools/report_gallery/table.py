"""Figure 11: the benchmark's numbers beside the report's."""

import html

# key of a row of `sahl bench report --json`, heading, of the report as well
COLUMNS = [("nodes", "nodes"), ("primitives", "leaves"), ("nodeVisits", "ray traversals"),
           ("primitiveTests", "triangle tests"), ("buildSeconds", "tree [s]"), ("renderSeconds", "rendering [s]")]


def number(value):
    """Counts and the report's whole seconds without decimals, ours with as many as tell something."""
    if isinstance(value, int) or value == int(value):
        return f"{int(value):,}"
    return f"{value:.2f}" if value >= 0.1 else f"{value:.2g}"


def cell(row, key):
    """Ours, the report's, and ours to theirs."""
    ours = number(row[key])
    theirs = row.get("report", {}).get(key)
    if theirs is None:
        return f"<td><b>{ours}</b><small>&nbsp;</small></td>"
    ratio = f" &times; {row[key] / theirs:.3g}" if theirs else ""
    return f"<td><b>{ours}</b><small>{number(theirs)}{ratio}</small></td>"


def benchmark(bench):
    """An HTML table of what `sahl bench report --json` wrote."""
    head = "".join(f"<th>{heading}</th>" for _, heading in COLUMNS)
    head += "<th>traversals a ray</th><th>tests a ray</th>"
    rows = []
    for row in bench["rows"]:
        cells = "".join(cell(row, key) for key, _ in COLUMNS)
        cells += f"<td>{row['nodeVisitsPerRay']:.2f}</td><td>{row['primitiveTestsPerRay']:.2f}</td>"
        rows.append(f"<tr><th>{html.escape(row['scene'])}</th>{cells}</tr>")
    for missing in bench.get("missing", []):
        rows.append(f'<tr><th>{html.escape(missing["scene"])}</th><td colspan="{len(COLUMNS) + 2}" '
                    f'style="text-align: left">not measured: {html.escape(missing["reason"])}</td></tr>')
    return (f'<div class="table"><table><thead><tr><th>scene</th>{head}</tr></thead>'
            f'<tbody>{"".join(rows)}</tbody></table></div>'
            '<p class="note">Small: the report&#8217;s number, and ours as a multiple of it. As the report counts '
            "them, nodes are boxes of the tree with or without children, and leaves are triangles; a traversal "
            "is a visit of a box by a ray. See docs/bench.md.</p>")
