"""Scene files of Mitsuba as trees of plain values: defaults put in, included files read, ids looked up.
What the values mean is the matter of mitsuba_scene."""

import pathlib
import xml.etree.ElementTree

import transforms as tr


class Unsupported(Exception):
    """A feature that Sahl does not have. The text names it."""


def numbers(text):
    return [float(word) for word in text.replace(",", " ").split()]


class Document:
    def __init__(self, path, common):
        self.folders = [pathlib.Path(path).parent, common]
        self.defaults, self.ids = {}, {}
        self.nodes = self._read(pathlib.Path(path))

    def _read(self, path):
        nodes = []
        for node in xml.etree.ElementTree.parse(path).getroot():
            if node.tag == "default":
                self.defaults.setdefault(node.get("name"), node.get("value"))
            elif node.tag == "include":
                nodes += self._read(self.file(node.get("filename")))
            elif node.tag != "path":
                nodes.append(node)
        for node in nodes:
            for inner in node.iter():
                if inner.get("id") and inner.tag != "ref":
                    self.ids[inner.get("id")] = inner
        return nodes

    def file(self, name):
        for folder in self.folders:
            if (folder / name).exists():
                return folder / name
        raise Unsupported(f"the file {name}, which is missing")

    def text(self, node, attribute="value"):
        value = node.get(attribute)
        return self.defaults[value[1:]] if value.startswith("$") else value

    def resolved(self, node):
        return self.ids[node.get("id")] if node.tag == "ref" else node

    def child(self, node, name):
        """The property of that name, or None."""
        found = [child for child in node if child.get("name") == name]
        return self.resolved(found[0]) if found else None

    def number(self, node, name, otherwise):
        child = self.child(node, name)
        return otherwise if child is None else float(self.text(child))

    def word(self, node, name, otherwise):
        child = self.child(node, name)
        return otherwise if child is None else self.text(child)

    def color(self, node, name, otherwise):
        """Red, green, blue of a property without texture."""
        child = self.child(node, name)
        if child is None:
            return [otherwise] * 3
        if child.tag == "texture":
            raise Unsupported(f"a texture as {name}")
        text = self.text(child)
        if ":" in text:
            raise Unsupported(f"a spectrum as {name}")
        values = numbers(text)
        return values * 3 if len(values) == 1 else values

    def members(self, node, tag):
        """Children of a kind, references to such among them."""
        return [self.resolved(child) for child in node if self.resolved(child).tag == tag]

    def transform(self, node, name="to_world"):
        """What its steps do one after another."""
        matrix = tr.identity()
        child = self.child(node, name)
        for step in child if child is not None else ():
            matrix = tr.times(self._step(step), matrix)
        return matrix

    def _step(self, step):
        if step.tag == "lookat":
            return tr.look_at(*(numbers(step.get(name)) for name in ("origin", "target", "up")))
        if step.tag == "rotate":
            return tr.rotation(triple(step, 0), float(step.get("angle")))
        if step.tag == "scale":
            return tr.scaling(*triple(step, 1))
        if step.tag == "translate":
            return tr.translation(*triple(step, 0))
        if step.tag == "matrix":
            values = numbers(step.get("value"))
            return [values[4 * i:4 * i + 4] for i in range(4)]
        raise Unsupported(f"the transform {step.tag}")


def triple(node, otherwise):
    """Three numbers as attributes x, y, z, as three values, or as one for all."""
    if node.get("value"):
        values = numbers(node.get("value"))
        return values * 3 if len(values) == 1 else values
    return [float(node.get(axis, otherwise)) for axis in "xyz"]
