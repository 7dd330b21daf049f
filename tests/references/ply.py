"""PLY files (binary, little endian) with what they say of each face, as triangles of Sahl's scenes."""

import struct

CODES = {"char": "b", "uchar": "B", "int8": "b", "uint8": "B", "short": "h", "ushort": "H", "int16": "h",
         "uint16": "H", "int": "i", "uint": "I", "int32": "i", "uint32": "I", "float": "f", "float32": "f",
         "double": "d", "float64": "d"}


def read(path):
    """Elements by name, each a list of dictionaries from property to number or list."""
    data = path.read_bytes()
    head, _, body = data.partition(b"end_header\n")
    lines = [line.split() for line in head.decode("ascii").splitlines()]
    if ["format", "binary_little_endian", "1.0"] not in lines:
        raise ValueError(f"{path}: not of the kind that is read here")
    elements, at, found = [], 0, {}
    for words in lines:
        if words and words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words and words[0] == "property":
            elements[-1][2].append(words[1:])
    for name, count, properties in elements:
        found[name] = []
        for _ in range(count):
            item = {}
            for words in properties:
                if words[0] == "list":
                    (length,), at = take(body, at, CODES[words[1]])
                    item[words[3]], at = take(body, at, f"{length}{CODES[words[2]]}")
                else:
                    (item[words[1]],), at = take(body, at, CODES[words[0]])
            found[name].append(item)
    return found


def take(body, at, code):
    code = "<" + code
    return struct.unpack_from(code, body, at), at + struct.calcsize(code)


def by_face(path, material):
    """A shape for every material that faces have, with that material.
      material  makes it of a face's properties"""
    mesh = read(path)
    positions = [[vertex[axis] for axis in "xyz"] for vertex in mesh["vertex"]]
    normals = [[vertex[axis] for axis in ("nx", "ny", "nz")] for vertex in mesh["vertex"]]
    parts = {}
    for face in mesh["face"]:
        made = material(face)
        parts.setdefault(str(made), (made, []))[1].append(list(face["vertex_indices"]))
    for made, faces in parts.values():
        used = sorted({corner for face in faces for corner in face})
        place = {corner: i for i, corner in enumerate(used)}
        yield {"type": "triangles", "positions": [positions[i] for i in used], "normals": [normals[i] for i in used],
               "indices": [[place[i] for i in face] for face in faces]}, made
