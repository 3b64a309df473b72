"""dressed_body.py BODY.off OUT.glb: the body with what people's files have beside it: a picture on it, and three morph targets.

One target moves all vertices, one the head alone (its accessor is sparse), one nothing (its accessor has no view)."""

import json
import struct
import sys
import zlib
from pathlib import Path

import numpy as np

SIDE = 8  # pixels of the picture


def picture():
    """A PNG, no two of whose pixels are alike."""
    y, x = np.mgrid[:SIDE, :SIDE]
    colours = np.stack([x * 255 // (SIDE - 1), y * 255 // (SIDE - 1), (x + y) % 2 * 255], 2).astype(np.uint8)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", SIDE, SIDE, 8, 2, 0, 0, 0)
    rows = b"".join(b"\0" + row.tobytes() for row in colours)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


class Buffer:
    def __init__(self):
        self.data, self.views, self.accessors = b"", [], []

    def view(self, data):
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data + bytes(-len(data) % 4)
        return len(self.views) - 1

    def accessor(self, rows, **more):
        """Of an array; with `sparse`, the rows that it has alone."""
        floats = rows.dtype == np.float32
        kind = {1: "SCALAR", 2: "VEC2", 3: "VEC3"}[rows.shape[1]]
        self.accessors.append({"componentType": 5126 if floats else 5125, "count": len(rows), "type": kind, **more})
        if floats:
            self.accessors[-1] |= {"min": rows.min(0).tolist(), "max": rows.max(0).tolist()}
        return len(self.accessors) - 1

    def full(self, rows):
        return self.accessor(rows, bufferView=self.view(rows.tobytes()))

    def sparse(self, rows):
        (places,) = np.nonzero(rows.any(1))
        parts = {"count": len(places)}
        parts["indices"] = {"bufferView": self.view(places.astype("<u4").tobytes()), "componentType": 5125}
        parts["values"] = {"bufferView": self.view(rows[places].tobytes())}
        return self.accessor(rows, sparse=parts)


words = Path(sys.argv[1]).read_text(encoding="ascii").split()
vertices, faces = int(words[1]), int(words[2])
points = np.array(words[4 : 4 + 3 * vertices], np.float32).reshape(-1, 3)
corners = np.array(words[4 + 3 * vertices :], np.uint32).reshape(faces, 4)[:, 1:].reshape(-1, 1)

heights = (points[:, 2] - points[:, 2].min()) / np.ptp(points[:, 2])  # z is up
around = points - points.mean(0)
around[:, 2] = 0
breath = (0.05 * around).astype(np.float32)
nod = np.where(heights[:, None] > 0.9, np.float32([0, -0.03, 0.01]), np.float32(0))
texture = np.stack([np.arctan2(around[:, 1], around[:, 0]) / (2 * np.pi) + 0.5, 1 - heights], 1).astype(np.float32)

out = Buffer()
attributes = {"POSITION": out.full(points), "TEXCOORD_0": out.full(texture)}
targets = [out.full(breath), out.sparse(nod), out.accessor(np.zeros_like(points))]
scene = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "dressed", "mesh": 0}],
    "meshes": [
        {
            "primitives": [
                {
                    "attributes": attributes,
                    "indices": out.full(corners),
                    "material": 0,
                    "targets": [{"POSITION": target} for target in targets],
                }
            ],
            "weights": [0.5, 0.75, 0.25],
            "extras": {"targetNames": ["breath", "nod", "nothing"]},
        }
    ],
    "materials": [{"name": "cloth", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}}],
    "textures": [{"source": 0}],
    "images": [{"name": "checks", "mimeType": "image/png", "bufferView": out.view(picture())}],
}
scene |= {"accessors": out.accessors, "bufferViews": out.views, "buffers": [{"byteLength": len(out.data)}]}
text = json.dumps(scene).encode()
text += b" " * (-len(text) % 4)
parts = [struct.pack("<II", len(part), kind) + part for kind, part in ((0x4E4F534A, text), (0x004E4942, out.data))]
Path(sys.argv[2]).write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + sum(map(len, parts))) + b"".join(parts))
